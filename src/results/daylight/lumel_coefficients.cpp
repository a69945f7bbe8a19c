// Direct light by sky_rays.h; the links of LinkRadiosity carry it from lumel to lumel, kLampLanes
// sources at once.

#include "results/daylight/lumel_coefficients.h"

#include <algorithm>
#include <cmath>

#include "base/core/parallel.h"
#include "links/trace/links.h"
#include "results/daylight/sky_rays.h"
#include "scene/sky/sky_patches.h"

namespace lumel {
namespace {

constexpr std::size_t kDaylitPerStep = 2048, kDaylitPerTask = 64, kLanesPerTask = 4096;
/// Shares of the work, for the progress bar only: direct light, then links.
constexpr double kDirectPart = 0.5, kTracedPart = 0.7;

bool is_buried(const SolveScene& scene, std::size_t lumel)
{
    return (scene.lumels.lumels[lumel].flags & kLumelBuried) != 0;
}

/// [N][sources]
std::vector<glm::vec3> direct_coefficients(const SolveScene& scene,
                                           std::span<const glm::vec3> places,
                                           const CoefficientRays& rays,
                                           const ProgressCallback& progress)
{
    const SkyPatches patches;
    const SkyRays sent(scene);
    const std::size_t lumels = scene.lumels.lumels.size(), count = patches.count() + places.size();
    const auto sun_rays = std::uint32_t(std::ceil(double(rays.sun) / double(lumels + 1)));
    std::vector<glm::vec3> found(lumels * count, glm::vec3(0.0f));
    const auto find = [&](std::size_t i) {
        glm::vec3* const light = &found[i * count];
        sent.visit(i, rays.sky, rays.seed,
                   [&](const glm::vec3& direction, const glm::vec3& arrived) {
                       const std::uint32_t patch = patches.at(direction);
                       if (patch != SkyPatches::kNone)
                           light[patch] += arrived;
                   });
        for (std::uint32_t s = 0; s < places.size(); ++s)
            light[patches.count() + s] = sent.sun(i, places[s], s, sun_rays, rays.seed);
    };
    parallel_steps(
        lumels, kDaylitPerStep, kDaylitPerTask,
        [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                if (!is_buried(scene, i))
                    find(i);
        },
        [&](std::size_t done) {
            notify(progress, double(done) / double(lumels));
            return true;
        });
    return found;
}

}  // namespace

std::vector<glm::vec3> lumel_coefficients(const SolveScene& scene,
                                          std::span<const glm::vec3> places,
                                          const CoefficientRays& rays, const CoefficientOf& of,
                                          const ProgressCallback& progress)
{
    std::vector<glm::vec3> found =
        direct_coefficients(scene, places, rays, part_of(progress, 0.0, kDirectPart));
    // Links, whatever the light.
    LinkRadiosity links(
        scene,
        LinksOptions{
            .seed = rays.seed, .filter = false, .even_rays = rays.links, .outside_light = true},
        {});
    while (!links.state().ended) {
        notify(progress, kDirectPart);
        links.step();
    }
    const std::size_t lumels = scene.lumels.lumels.size(),
                      count = SkyPatches().count() + places.size();
    std::vector<glm::vec3> lanes(lumels * kLampLanes);
    for (std::size_t first = 0; first < count; first += kLampLanes) {
        notify(progress, kTracedPart + (1.0 - kTracedPart) * double(first) / double(count));
        const std::size_t width = std::min(kLampLanes, count - first);
        for (std::size_t i = 0; i < lumels; ++i)
            for (std::size_t lane = 0; lane < kLampLanes; ++lane)
                lanes[i * kLampLanes + lane] =
                    lane < width ? found[i * count + first + lane] : glm::vec3(0.0f);
        const std::vector<glm::vec3> bounced = links.reflected(lanes);
        parallel_for(lumels, kLanesPerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = from; i < to; ++i)
                for (std::size_t lane = 0; lane < width && !is_buried(scene, i); ++lane) {
                    glm::vec3& light = found[i * count + first + lane];
                    light = of(i, first + lane, light, bounced[i * kLampLanes + lane]);
                }
        });
    }
    return found;
}

std::uint64_t lumel_coefficient_bytes(std::size_t lumels, std::size_t places)
{
    // As much again by the caller; the links, and the light of some sources in sub-lumels.
    constexpr std::uint64_t kCopies = 3;
    return kCopies * lumels * (SkyPatches().count() + places) * sizeof(glm::vec3);
}

}  // namespace lumel
