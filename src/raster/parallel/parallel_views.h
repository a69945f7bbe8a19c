#pragma once
// Depth images of the scene by parallel projection along directions.

#include <cstdint>
#include <limits>

#include "gpu/pacer.h"
#include "raster/parallel/parallel.cut_out.raster.h"
#include "raster/parallel/parallel.raster.h"
#include "raster/parallel/parallel_views.shared.h"
#include "raster/world/surface_rasters.h"
#include "raster/world/tiles.h"
#include "raster/world/world.h"

namespace lumel {

/// Parameters of a parallel view.
struct ParallelPose {
    glm::vec3 toward{0.0f, 1.0f, 0.0f};    ///< unit, from the scene to the light
    float turn = 0.0f;                     ///< rotation of the image about `toward` [rad]
    glm::vec2 offset{0.5f};                ///< shift of the pixel grid, 0…1
    std::uint32_t random = 0;              ///< seed for the random opacity of surfaces with alpha
    std::uint32_t channel = kAllChannels;  ///< colour channel of the view
};

/// The largest view of a whole box that fits a tile of side × side pixels.
ParallelView fit_view(const glm::vec3& low, const glm::vec3& high, std::uint32_t side,
                      const ParallelPose& pose);

/// Side of parallel views in which typical lumels are `pixels` wide, within limits. diagonal: of
/// the scene's bounding box [m]; most: maximum side [pixels].
std::uint32_t parallel_side(const Lumels& lumels, float diagonal, float pixels,
                            std::uint32_t most = std::numeric_limits<std::uint32_t>::max());

/// A nearly square layout of `capacity` tiles of that side in an image, or of as many as fit the
/// device's maximum.
ParallelLayout tile_layout(const gpu::Device& device, std::uint32_t side, std::uint32_t capacity);
Tiles tiles_of(const ParallelLayout& layout);

/// Depth images of `capacity` directions, tiled in one image. Kernels read them through
/// raster/parallel/piece_along.glsl and first_met.glsl.
class ParallelViews {
public:
    /// side: of each image [pixels]. `capacity` is an upper limit; it is reduced to fit the
    /// device's images.
    ParallelViews(const gpu::Device& device, const World& world, std::uint32_t side,
                  std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    const ParallelLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }

    /// Renders views [first, first + count) to tiles 0, 1, …, including the scene's hull.
    void look_along(gpu::Pacer& pacer, const gpu::Array<ParallelView>& views, std::uint32_t first,
                    std::uint32_t count);

private:
    void draw(gpu::Commands& commands, const gpu::Array<ParallelView>& views, std::uint32_t view,
              std::uint32_t tile);

    const World* world_;
    ParallelLayout layout_;
    std::uint32_t capacity_;
    gpu::Target image_;
    gpu::Sampler sampler_;
    SurfaceRasters<shaders::Parallel, shaders::ParallelCutOut> rasters_;
};

}  // namespace lumel
