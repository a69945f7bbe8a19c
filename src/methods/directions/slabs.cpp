#include "methods/directions/slabs.h"

#include <cmath>

#include "base/core/sphere.h"
#include "gpu/pacer.h"
#include "raster/parallel/illumination_maps.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Directions and map side [pixels] to measure the overdraw: it hardly depends on the resolution.
constexpr std::uint32_t kTriedDirections = 8, kTriedSide = 128;
/// Stops adding slabs when a surface is among the lookups with this probability.
constexpr double kLikelyEnough = 0.999;
/// Spread of the measured overdraw of a scene without any: 50,000 pixels give it within 0.5 %.
constexpr double kSpread = 0.02;
/// Maximum pixels of the maps of one direction (192 MiB).
constexpr std::uint64_t kMaxSlabPixels = 16u << 20;

gpu::Array<ParallelView> tried_views(const gpu::Device& device, const World& world,
                                     std::uint32_t seed)
{
    std::vector<ParallelView> views;
    for (std::uint32_t i = 0; i < kTriedDirections; ++i) {
        const PathSamples samples(seed, i);
        views.push_back(
            fit_view(world.low(), world.high(), kTriedSide,
                     {.toward = on_sphere(samples.stratified(0)), .random = samples.bits(1)}));
    }
    return {device, std::span<const ParallelView>(views)};
}

}  // namespace

double chance_found(double surfaces, int lookups)
{
    return 1.0 - std::pow(1.0 - 1.0 / std::max(surfaces, 1.0), double(lookups));
}

std::uint32_t suitable_slabs(const gpu::Device& device, const World& world, std::uint32_t side,
                             const DirectionsOptions& options)
{
    if (options.layers != Layers::stochastic)
        return 1;
    if (options.slabs > 0)
        return options.slabs;
    const gpu::Array<ParallelView> views = tried_views(device, world, options.seed);
    gpu::Pacer pacer(device);
    const auto fits = [&](std::uint32_t slabs) {
        return slabs <= kMaxTriedSlabs &&
               std::uint64_t(side) * side * maps_of_slabs(slabs) <= kMaxSlabPixels;
    };
    for (std::uint32_t slabs = 1;; slabs *= 2) {
        if (!fits(2 * slabs))
            return slabs;
        IlluminationMaps maps(device, world, Layers::stochastic, kTriedSide, kTriedDirections, 1, 1,
                              slabs);
        maps.look_along(pacer, views, 0, maps.capacity());
        pacer.finish();
        const double surfaces = maps.overdraw(maps.capacity()) - kSpread;
        if (chance_found(surfaces, options.lookups * options.lookups) >= kLikelyEnough)
            return slabs;
    }
}

}  // namespace lumel
