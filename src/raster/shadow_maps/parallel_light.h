#pragma once
// Light of sky and sun, by parallel views.

#include <cstdint>
#include <functional>
#include <vector>

#include "raster/parallel/parallel_views.h"
#include "raster/shadow_maps/light_sums.h"
#include "raster/shadow_maps/parallel_light.receive.comp.h"
#include "raster/shadow_maps/parallel_light.shared.h"
#include "scene/values/scene.h"

namespace lumel {

/// `count` samples of the whole sky: half of them by brightness, half uniform, weighted by the
/// balance heuristic [VG95]. Empty for a dark sky or a count of 0.
std::vector<ParallelSource> sky_sources(const Sky& sky, std::uint32_t count, std::uint32_t seed);

/// `count` directions, uniform over the light's disc. Without a disc they are equal and differ only
/// by their pixel grids.
std::vector<ParallelSource> sun_sources(const PunctualLight& light, std::uint32_t count,
                                        std::uint32_t seed);

struct ParallelLightOptions {
    std::uint32_t side = 512;  ///< view side [pixels]
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds the direct irradiance of some directions to a sum, as one source, some views per step. The
/// division into steps does not change the result.
class ParallelLight {
public:
    /// device, world and light must outlive this, and the world must not change.
    ParallelLight(const gpu::Device& device, const World& world,
                  const std::vector<ParallelSource>& sources, const ParallelLightOptions& options,
                  SummedLight& light);

    /// Renders views of about `pixels` pixels in total, at least one view, and adds their light.
    /// Waits for the GPU after the last.
    void step(std::uint64_t pixels);
    void wait() { pacer_.finish(); }
    bool is_done() const { return next_ == total_; }
    /// Fraction of the work that is done.
    double done() const { return total_ > 0 ? double(next_) / double(total_) : 1.0; }
    /// Accepts the light found so far as complete. Waits for the GPU.
    void finish();

private:
    const World* world_;
    ParallelLightOptions options_;
    SummedLight* light_;
    std::uint32_t total_, views_per_source_, next_ = 0;
    gpu::Array<ParallelView> views_;
    gpu::Array<ParallelSource> sources_;
    ParallelViews images_;
    gpu::Kernel<shaders::ParallelLightReceive> receive_;
    gpu::Pacer pacer_;  ///< last: its destructor waits for work that uses the others
};

/// Pixels of a batch of views.
std::uint64_t parallel_light_pixels(const ParallelLightOptions& options);

}  // namespace lumel
