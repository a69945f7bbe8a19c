#pragma once
// Light from infinitely far away: sky and sun, through parallel views.

#include <cstdint>
#include <functional>
#include <vector>

#include "raster/parallel/parallel_views.h"
#include "raster/shadow_maps/light_sums.h"
#include "raster/shadow_maps/parallel_light.receive.comp.h"
#include "raster/shadow_maps/parallel_light.shared.h"
#include "scene/values/scene.h"

namespace lumel {

/// `count` directions that stand for the whole sky: half of them drawn by its brightness, half
/// evenly, weighted by the balance heuristic [VG95]. None for a dark sky or a count of 0.
std::vector<ParallelSource> sky_sources(const Sky& sky, std::uint32_t count, std::uint32_t seed);

/// `count` directions, evenly spread over the light's disc; all the same where it has none. Only
/// where their pixels lie differs then.
std::vector<ParallelSource> sun_sources(const PunctualLight& light, std::uint32_t count,
                                        std::uint32_t seed);

struct ParallelLightOptions {
    std::uint32_t side = 512;  ///< of each view [pixels]
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds the direct light of some directions at the lumels to a sum, as one source, some of them at
/// a time. How they are cut does not change the result.
class ParallelLight {
public:
    /// device, world and light must outlive it, and the world stay as it is.
    ParallelLight(const gpu::Device& device, const World& world,
                  const std::vector<ParallelSource>& sources, const ParallelLightOptions& options,
                  SummedLight& light);

    /// Draws views of about `pixels` in all, one at least, and adds their light. Waits for the
    /// device after the last.
    void step(std::uint64_t pixels);
    void wait() { pacer_.finish(); }
    bool is_done() const { return next_ == total_; }
    /// Part of the whole.
    double done() const { return total_ > 0 ? double(next_) / double(total_) : 1.0; }
    /// Counts what has been found as the whole. Waits for the device.
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
    gpu::Pacer pacer_;  ///< after all that its work uses: it waits when it ends
};

/// Pixels of the views of one batch.
std::uint64_t parallel_light_pixels(const ParallelLightOptions& options);

}  // namespace lumel
