// Irradiance is the light that white diffuse reflects; see path_tracer.cpp.

#include "truth/reference.h"

#include "truth/averages.h"
#include "truth/lumel_starts.h"
#include "truth/path_tracer.h"

namespace lumel {

namespace {

/// Key of the random numbers of maps, independent of those of images.
constexpr std::uint32_t kMapKey = 0;

}  // namespace

std::vector<glm::vec3> reference_irradiance(const Scene& scene, const RayScene& rays,
                                            const Lumels& lumels, const ReferenceOptions& options,
                                            const std::function<bool(double)>& progress)
{
    const PathTracer tracer(scene, rays, options.max_bounces, options.parts);
    const LumelStarts starts(scene, rays, lumels, options.rule);
    const std::uint32_t key = PathSamples::hash(options.seed, kMapKey);
    const auto estimate = [&](std::size_t i, std::uint32_t sample) {
        if (lumels.lumels[i].flags & kLumelBuried)
            return glm::vec4(0.0f);
        const PathSamples samples(PathSamples::hash(key, std::uint32_t(i)), sample);
        const PathVertex vertex = starts.start(i, samples.stratified(kStartPair));
        return glm::vec4(tracer.reflected(vertex, samples), 0.0f);
    };
    const std::vector<glm::vec4> means =
        average(lumels.lumels.size(), options.samples_per_lumel, estimate, progress);
    return {means.begin(), means.end()};
}

}  // namespace lumel
