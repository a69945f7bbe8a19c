#pragma once
// Irradiance of any normal at any place, by paths.

#include <functional>
#include <vector>

#include "truth/averages.h"
#include "truth/bounce_samples.h"
#include "truth/path_tracer.h"

namespace lumel::support {

/// Where the paths of a place begin: Brdf(normal) tells the normal; light comes from above
/// `geometric` alone.
using PathStart = std::function<PathVertex(std::size_t place, const PathSamples& samples)>;

/// H [count] [lx]: what white matte would send out there.
inline std::vector<glm::vec3> path_irradiance(const Scene& scene, const RayScene& rays,
                                              std::size_t count, int samples,
                                              const PathStart& start)
{
    constexpr int kMaxBounces = 1024;
    const PathTracer tracer(scene, rays, kMaxBounces);
    const std::vector<glm::vec4> means =
        average(count, samples,
                [&](std::size_t i, std::uint32_t sample) {
                    const PathSamples path(PathSamples::hash(7, std::uint32_t(i)), sample);
                    return glm::vec4(tracer.reflected(start(i, path), path), 0.0f);
                },
                {});
    return {means.begin(), means.end()};
}

}  // namespace lumel::support
