#pragma once
// look_along: what a direction sees of the whole scene, as depth, by parallel projection.

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

/// Where a parallel view stands in the space of all that show the world from one direction.
struct ParallelPose {
    glm::vec3 toward{0.0f, 1.0f, 0.0f};    ///< unit, from the scene to the light
    float turn = 0.0f;                     ///< of the picture about `toward` [rad]
    glm::vec2 offset{0.5f};                ///< of its pixels, 0…1
    std::uint32_t random = 0;              ///< seeds the chance by which surfaces with alpha block
    std::uint32_t channel = kAllChannels;  ///< that is looked in
};

/// The view that shows a whole box, as large as fits a tile of side × side pixels.
ParallelView fit_view(const glm::vec3& low, const glm::vec3& high, std::uint32_t side,
                      const ParallelPose& pose);

/// The side of parallel views that shows typical lumels that number of pixels wide, within limits.
/// diagonal: of the scene's bounding box [m]; most: side that the device's images may have
/// [pixels].
std::uint32_t parallel_side(const Lumels& lumels, float diagonal, float pixels,
                            std::uint32_t most = std::numeric_limits<std::uint32_t>::max());

/// How tiles of that side lie in an image, about square, that holds `capacity` of them if it may be
/// so large.
ParallelLayout tile_layout(const gpu::Device& device, std::uint32_t side, std::uint32_t capacity);
Tiles tiles_of(const ParallelLayout& layout);

/// Depth images of what `capacity` directions see, side by side in one image. A kernel reads them
/// through raster/parallel/piece_along.glsl and first_met.glsl.
class ParallelViews {
public:
    /// side: of each image [pixels]. The capacity given is what fits the device's images and is at
    /// most the one requested.
    ParallelViews(const gpu::Device& device, const World& world, std::uint32_t side,
                  std::uint32_t capacity);

    std::uint32_t capacity() const { return capacity_; }
    const ParallelLayout& layout() const { return layout_; }
    const gpu::Target& image() const { return image_; }
    const gpu::Sampler& sampler() const { return sampler_; }

    /// Draws views [first, first + count) into tiles 0, 1, …, with the walls on the scene's hull.
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
