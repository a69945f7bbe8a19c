#include "raster/shadow_maps/live_lamps.h"

#include <algorithm>
#include <limits>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSky = std::numeric_limits<std::uint32_t>::max();

/// Pixels per step, for callers with a time budget: about one hemicube of a lamp.
constexpr std::uint64_t kPixelsAStep = 1u << 20;

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

void LiveLamps::begin(const gpu::Device& device, const World& world, const Lumels& lumels)
{
    device_ = &device;
    world_ = &world;
    lumels_ = &lumels;
    at_ = 0;
    search();
}

void LiveLamps::find(const gpu::Device& device, const World& world, const Lumels& lumels)
{
    begin(device, world, lumels);
    while (is_under_way())
        step();
}

/// Starts the next source.
void LiveLamps::search()
{
    search_.reset();
    if (at_ < sources_.size())
        search_.emplace(*device_, *world_, sources_[at_].scene, *lumels_, options_);
}

bool LiveLamps::step()
{
    if (!search_)
        return false;
    if (!search_->is_done()) {
        search_->step(kPixelsAStep);
        search_->wait();
    }
    if (search_->is_done()) {
        sources_[at_].fresh = search_->take().irradiance;
        ++at_;
        search();
    }
    if (search_)
        return true;
    for (Source& source : sources_)
        source.irradiance = std::move(source.fresh);
    return false;
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
