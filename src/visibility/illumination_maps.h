#pragma once
// Illumination maps: all surfaces that lie along a direction, by parallel projection.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <cstdint>

#include "gpu/pacer.h"
#include "visibility/illumination_maps.shared.h"
#include "visibility/parallel_views.h"
#include "world/world.h"

namespace lumel {

enum class Layers : std::uint32_t {
    stochastic = kStochasticLayers,  ///< [TN11] section 3: one surface a pixel, by chance
    list = kListedLayers,            ///< every surface, in a list for each pixel
    peel = kPeeledLayers,            ///< every surface, one a pixel in each of several passes
};

/// Maps of `capacity` directions, side by side. Fragments name lumels, by side and texel, not
/// colours: so one map serves emitted and reflected light.
class IlluminationMaps {
public:
    /// side: of each map [pixels]. width, height: of the atlas [texels], which `world` must know.
    /// The capacity given is what fits the device and is at most the one asked for.
    /// Throws Error{device} if the device cannot keep lists.
    IlluminationMaps(const gpu::Device& device, const World& world, Layers layers,
                     std::uint32_t side, std::uint32_t capacity, std::uint32_t width,
                     std::uint32_t height);

    std::uint32_t capacity() const { return capacity_; }
    const ParallelLayout& layout() const { return layout_; }
    /// Stochastic: (surface, nearness). Peeled: of that layer, or of the one two before.
    const gpu::Target& image(std::uint32_t layer = 0) const
    {
        return layer % 2 == 0 ? image_ : odd_image_;
    }
    const gpu::Sampler& sampler() const { return sampler_; }
    const gpu::Array<std::uint32_t>& heads() const { return heads_; }     ///< of lists
    const gpu::Array<Fragment>& fragments() const { return fragments_; }  ///< of lists

    /// Draws views [first, first + count) into tiles 0, 1, … With Layers::peel: what lies behind
    /// the layer before, which was the last to be drawn; layer 0 is what the direction's light
    /// meets first.
    void look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views, std::uint32_t first,
                    std::uint32_t count, std::uint32_t layer = 0);

    /// Share of its fragments that lists had room for in the worst of all calls so far. Waits for
    /// the device.
    double kept() const;

private:
    void draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
              const IlluminationParams& params);
    bool lists() const { return layers_ == Layers::list; }
    bool peels() const { return layers_ == Layers::peel; }

    const World* world_;
    Layers layers_;
    ParallelLayout layout_;
    std::uint32_t capacity_, width_, height_;
    gpu::Target image_, odd_image_, depth_;
    gpu::Sampler sampler_;
    gpu::Array<std::uint32_t> heads_;
    gpu::Array<Fragment> fragments_;
    gpu::Array<std::uint32_t> none_;  ///< a count of no fragments
    gpu::Array<FragmentCount> count_;
    gpu::Raster opaque_, cut_out_;
};

}  // namespace lumel
