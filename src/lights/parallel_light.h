#pragma once
// Light from infinitely far away: sky and sun, through parallel views.

#include <cstdint>
#include <functional>
#include <vector>

#include "lights/light_sums.h"
#include "lights/parallel_light.shared.h"
#include "scene/scene.h"
#include "visibility/parallel_views.h"

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

/// Adds the direct light of these directions at the lumels to `light`, as one source. `go_on`
/// receives the fraction done and returns false to stop. Returns false if it was stopped.
bool add_parallel_light(const gpu::Device& device, const World& world,
                        const std::vector<ParallelSource>& sources,
                        const ParallelLightOptions& options, SummedLight& light,
                        const std::function<bool(double)>& go_on);

/// Pixels of the views of one batch.
std::uint64_t parallel_light_pixels(const ParallelLightOptions& options);

}  // namespace lumel
