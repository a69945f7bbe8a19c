#include "live/live_lamps.h"

#include <algorithm>
#include <limits>

#include "core/error.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSky = std::numeric_limits<std::uint32_t>::max();

}  // namespace

LiveLamps::LiveLamps(const Scene& scene, const DirectLightOptions& options) : options_(options)
{
    if (!scene.sky.empty()) {
        Source& source = sources_.emplace_back(Source{{}, kSky});
        source.scene.sky = scene.sky;
    }
    for (std::uint32_t i = 0; i < scene.lights.size(); ++i) {
        Source& source = sources_.emplace_back(Source{{}, i});
        source.scene.lights = {scene.lights[i]};
        source.scene.profiles = scene.profiles;
    }
}

void LiveLamps::set(std::uint32_t light, const glm::vec3& factor, const std::string& name)
{
    const auto source = std::find_if(sources_.begin(), sources_.end(),
                                     [&](const Source& other) { return other.light == light; });
    if (source == sources_.end())
        throw Error(ErrorKind::input, name, "is not in the scene");
    if (!glm::all(glm::greaterThanEqual(factor, glm::vec3(0.0f))))
        throw Error(ErrorKind::input, name, "cannot emit a negative amount of light");
    source->factor = factor;
}

void LiveLamps::set_light(std::uint32_t light, const glm::vec3& factor)
{
    set(light, factor, "light " + std::to_string(light));
}

void LiveLamps::set_sky(const glm::vec3& factor)
{
    set(kSky, factor, "the sky");
}

void LiveLamps::find(const gpu::Device& device, const World& world, const Lumels& lumels)
{
    for (Source& source : sources_)
        source.irradiance = direct_light(device, world, source.scene, lumels, options_).irradiance;
}

std::vector<glm::vec3> LiveLamps::irradiance() const
{
    std::vector<glm::vec3> sum;
    for (const Source& source : sources_) {
        sum.resize(source.irradiance.size(), glm::vec3(0.0f));
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += source.factor * source.irradiance[i];
    }
    return sum;
}

}  // namespace lumel
