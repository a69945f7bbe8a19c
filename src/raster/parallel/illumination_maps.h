#pragma once
// Illumination maps: all surfaces along a direction, by parallel projection.
//
//   [TN11] A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.

#include <cstdint>
#include <variant>

#include "gpu/pacer.h"
#include "raster/parallel/illumination.list.cut_out.raster.h"
#include "raster/parallel/illumination.list.raster.h"
#include "raster/parallel/illumination.peel.cut_out.raster.h"
#include "raster/parallel/illumination.peel.raster.h"
#include "raster/parallel/illumination.stochastic.cut_out.raster.h"
#include "raster/parallel/illumination.stochastic.raster.h"
#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/layers.h"
#include "raster/parallel/parallel_views.h"
#include "raster/world/surface_rasters.h"
#include "raster/world/world.h"

namespace lumel {

/// Number of maps of a direction that is divided into slabs: one per slab, and one for the surfaces
/// beyond each slab except the closest to the light.
constexpr std::uint32_t maps_of_slabs(std::uint32_t slabs)
{
    return 2 * slabs - 1;
}

/// Maps of `capacity` directions in one image. Fragments refer to lumels, by side and texel, not to
/// colours, so one map serves emitted and reflected light.
///
/// The regions of [TN11] section 6 are slabs of equal thickness along the direction. Slab s of S
/// has nearness s/S to (s + 1)/S, and a map in which only its own surfaces compete randomly. Beyond
/// it, ordinary depth selects the first surface, in a separate map: in the slab's map, the slab's
/// surfaces would hide surfaces beyond it from one another. A direction has maps_of_slabs(S) tiles:
/// slabs 0, 1, … S - 1, then beyond slabs 0, 1, … S - 2.
class IlluminationMaps {
public:
    /// side: of each map [pixels]. width, height: of the atlas [texels], which `world` must have.
    /// slabs: 1 unless layers are stochastic. `capacity` is an upper limit; it is reduced to fit
    /// the device. Throws Error{device} if the device does not support lists, or the maps of one
    /// direction do not fit its images.
    IlluminationMaps(const gpu::Device& device, const World& world, Layers layers,
                     std::uint32_t side, std::uint32_t capacity, std::uint32_t width,
                     std::uint32_t height, std::uint32_t slabs = 1);

    /// GPU memory for images and arrays of any size [bytes].
    static std::uint64_t device_bytes(Layers layers, std::uint32_t side, std::uint32_t capacity,
                                      std::uint32_t slabs = 1);

    std::uint32_t capacity() const { return capacity_; }  ///< number of directions
    std::uint32_t slabs() const { return slabs_; }
    const ParallelLayout& layout() const { return layout_; }
    /// Stochastic: (surface, nearness, its slopes per pixel). Peeled: (surface, nearness) of the
    /// layer, or of the one two before.
    const gpu::Target& image(std::uint32_t layer = 0) const
    {
        return layer % 2 == 0 ? image_ : odd_image_;
    }
    const gpu::Sampler& sampler() const { return sampler_; }
    const gpu::Array<std::uint32_t>& heads() const { return heads_; }  ///< first Fragment per pixel
    const gpu::Array<Fragment>& fragments() const { return fragments_; }  ///< list entries

    /// Renders views [first, first + count), each into its tiles. Layers::peel requires the
    /// previous layer to be the last rendered; layer 0 has the surfaces closest to the direction's
    /// light.
    void look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views, std::uint32_t first,
                    std::uint32_t count, std::uint32_t layer = 0);

    /// Minimum over all calls of the share of fragments that fitted into the lists. Waits for the
    /// GPU.
    double kept() const;

    /// Layers::stochastic: K, the number of surfaces that compete for a covered pixel, averaged
    /// over the slabs' maps of the first `count` directions of the last rendering; 0 if nothing is
    /// covered. Waits for the GPU; its work must be submitted.
    double overdraw(std::uint32_t count) const;

private:
    using StochasticRasters =
        SurfaceRasters<shaders::IlluminationStochastic, shaders::IlluminationStochasticCutOut>;
    using ListRasters = SurfaceRasters<shaders::IlluminationList, shaders::IlluminationListCutOut>;
    using PeelRasters = SurfaceRasters<shaders::IlluminationPeel, shaders::IlluminationPeelCutOut>;
    using Rasters = std::variant<StochasticRasters, ListRasters, PeelRasters>;

    /// Parameters of a pass over one layer.
    struct Pass {
        gpu::Commands& commands;
        const gpu::Array<ParallelView>& views;
        const IlluminationParams& params;
    };

    static Rasters make_rasters(const gpu::Device& device, Layers layers);
    auto use_opaque(const Pass& pass, const StochasticRasters& rasters) const;
    auto use_opaque(const Pass& pass, const ListRasters& rasters) const;
    auto use_opaque(const Pass& pass, const PeelRasters& rasters) const;
    auto use_cut_out(const Pass& pass, const StochasticRasters& rasters,
                     const CutOutDraw& cut_out) const;
    auto use_cut_out(const Pass& pass, const ListRasters& rasters, const CutOutDraw& cut_out) const;
    auto use_cut_out(const Pass& pass, const PeelRasters& rasters, const CutOutDraw& cut_out) const;
    void draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views,
              const IlluminationParams& params);
    bool lists() const { return layers_ == Layers::list; }
    bool peels() const { return layers_ == Layers::peel; }

    const World* world_;
    Layers layers_;
    ParallelLayout layout_;
    std::uint32_t slabs_, capacity_, width_, height_;
    gpu::Target image_, odd_image_, depth_;
    gpu::Sampler sampler_;
    gpu::Array<std::uint32_t> heads_;
    gpu::Array<Fragment> fragments_;
    gpu::Array<std::uint32_t> none_;  ///< placeholder: a count of no fragments
    gpu::Array<FragmentCount> count_;
    Rasters rasters_;
};

}  // namespace lumel
