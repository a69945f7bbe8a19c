#include "lights/direct_light.h"

#include <algorithm>

#include "lights/lamps.h"
#include "lights/parallel_light.h"

namespace lumel {
namespace {

std::vector<ParallelSource> parallel_sources(const Scene& scene, const DirectLightOptions& options)
{
    std::vector<ParallelSource> sources = sky_sources(scene.sky, options.sky_directions,
                                                      options.seed);
    for (const PunctualLight& light : scene.lights) {
        if (light.kind != PunctualLight::Kind::directional || !(light.intensity > 0.0f))
            continue;
        const std::uint32_t count =
            light.angle > 0.0f ? options.disc_directions : options.sun_directions;
        const std::vector<ParallelSource> sun = sun_sources(light, count, options.seed);
        sources.insert(sources.end(), sun.begin(), sun.end());
    }
    return sources;
}

}  // namespace

bool has_lights(const Scene& scene)
{
    return !scene.sky.empty() || !scene.lights.empty();
}

DirectLight direct_light(const gpu::Device& device, const World& world, const Scene& scene,
                         const Lumels& lumels, const DirectLightOptions& options,
                         const std::function<bool(double)>& go_on)
{
    const gpu::Array<glm::vec3> irradiance(device, lumels.lumels.size());
    gpu::Pacer pacer(device);
    pacer.work("prepare", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        commands.fill(irradiance.buffer());
    });
    // Neither kind of source says how long the other takes.
    const auto half = [&](double from) {
        return [&go_on, from](double fraction) { return !go_on || go_on(from + 0.5 * fraction); };
    };
    DirectLight light;
    light.finished =
        add_parallel_light(pacer, device, world, parallel_sources(scene, options),
                           {.side = parallel_side(device, world, lumels),
                            .seed = options.seed,
                            .centre = options.centre},
                           irradiance, half(0.0)) &&
        add_lamps(pacer, device, world, scene,
                  {.projection = options.projection,
                   .hemicube = options.hemicube,
                   .batch = options.batch,
                   .seed = options.seed,
                   .centre = options.centre},
                  irradiance, half(0.5));
    pacer.finish();
    light.irradiance = irradiance.download();
    light.times = pacer.times();
    return light;
}

}  // namespace lumel
