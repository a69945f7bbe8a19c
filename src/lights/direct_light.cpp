#include "lights/direct_light.h"

#include <algorithm>

#include "lights/lamps.h"
#include "lights/parallel_light.h"

namespace lumel {
namespace {

bool is_parallel(const PunctualLight& light)
{
    return light.kind == PunctualLight::Kind::directional;
}

/// Pixels of a view across a typical lumel. In the city of scenes/ under an even sky, 5 leave 1.1 %
/// of error where 3.5 leave 1.8 %, at a third more time.
constexpr float kPixelsPerLumel = 5.0f;

/// The directions of each source of parallel light.
std::vector<std::vector<ParallelSource>> parallel_sources(const Scene& scene,
                                                          const DirectLightOptions& options)
{
    std::vector<std::vector<ParallelSource>> sources{
        sky_sources(scene.sky, options.sky_directions, options.seed)};
    for (const PunctualLight& light : scene.lights) {
        if (!is_parallel(light) || !shines(light))
            continue;
        const std::uint32_t count =
            light.angle > 0.0f ? options.disc_directions : options.sun_directions;
        sources.push_back(sun_sources(light, count, options.seed));
    }
    return sources;
}

}  // namespace

bool has_lights(const Scene& scene)
{
    return !scene.sky.empty() || !scene.lights.empty();
}

std::uint64_t direct_light_bytes(const Scene& scene, const Lumels& lumels, float diagonal)
{
    std::uint64_t pixels = 0;
    if (!scene.sky.empty() || std::any_of(scene.lights.begin(), scene.lights.end(), is_parallel))
        pixels = parallel_light_pixels({.side = parallel_side(lumels, diagonal, kPixelsPerLumel)});
    if (!std::all_of(scene.lights.begin(), scene.lights.end(), is_parallel))
        pixels = std::max(pixels, lamp_pixels({}));
    const std::uint64_t sums = has_lights(scene) ? SummedLight::bytes(lumels.lumels.size()) : 0;
    return sums + pixels * sizeof(float);
}

DirectLight direct_light(const gpu::Device& device, const World& world, const Scene& scene,
                         const Lumels& lumels, const DirectLightOptions& options,
                         const std::function<bool(double)>& go_on)
{
    SummedLight summed(device, lumels.lumels.size());
    const std::vector<std::vector<ParallelSource>> sources = parallel_sources(scene, options);
    const double parts = double(sources.size()) + 1.0;  // the lamps are one
    double part = 0.0;
    const auto go_on_part = [&](double fraction) {
        return !go_on || go_on((part + fraction) / parts);
    };
    const ParallelLightOptions parallel{
        .side = parallel_side(lumels, world.diagonal(), kPixelsPerLumel, device.max_image_side()),
        .seed = options.seed,
        .centre = options.centre};
    DirectLight light;
    for (const std::vector<ParallelSource>& directions : sources) {
        light.finished = light.finished && add_parallel_light(device, world, directions, parallel,
                                                              summed, go_on_part);
        part += 1.0;
    }
    light.finished = light.finished && add_lamps(device, world, scene,
                                                 {.seed = options.seed, .centre = options.centre},
                                                 summed, go_on_part);
    light.irradiance = summed.irradiance();
    light.times = summed.times();
    return light;
}

}  // namespace lumel
