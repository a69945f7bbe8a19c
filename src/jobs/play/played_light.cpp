#include "jobs/play/played_light.h"

#include <algorithm>

#include <fmt/format.h>

#include "jobs/play/links_light.h"
#include "methods/directions/leaky_scene.h"
#include "methods/redistribution/live_scene.h"

namespace lumel {
namespace {

bool has_material(const Scene& scene, const Instance& instance, int material)
{
    const auto& primitives = scene.meshes[std::size_t(instance.mesh)].primitives;
    return std::any_of(primitives.begin(), primitives.end(),
                       [&](const Primitive& p) { return p.material == material; });
}

/// An emissive instance whose light is animated.
struct ChangingLamp {
    std::uint32_t instance = 0;
    const AnimatedMaterial* material = nullptr;
    glm::vec3 factor{1.0f};  ///< current in the live scene
};

std::vector<ChangingLamp> changing_lamps(const Scene& scene, const Animation& animation)
{
    std::vector<ChangingLamp> lamps;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        for (const AnimatedMaterial& material : animation.materials)
            if (has_material(scene, scene.instances[i], material.material))
                lamps.push_back({i, &material});
    return lamps;
}

/// Emission is scaled per instance: its other materials must not emit.
void check_lamps(const Scene& scene, const std::vector<ChangingLamp>& lamps)
{
    for (const ChangingLamp& lamp : lamps) {
        const Instance& instance = scene.instances[lamp.instance];
        for (int other = 0; other < int(scene.materials.size()); ++other)
            if (other != lamp.material->material && has_material(scene, instance, other) &&
                scene.materials[std::size_t(other)].emitted != glm::vec3(0.0f))
                throw Error(ErrorKind::input, fmt::format("{}: \"{}\"", scene.path, instance.name),
                            "has several emissive materials, and the light of one changes; give "
                            "each its own mesh");
    }
}

LiveOptions live_options(const PlayOptions& options, const std::vector<std::uint32_t>& movers)
{
    LiveOptions live;
    live.atlas = options.atlas;
    live.solver = std::get<ProgressiveOptions>(options.solver);
    live.movers = movers;
    live.still = movers.empty();
    // If only lamps change, nothing is crossed.
    live.redistribution = live.still ? Redistribution::incremental : options.redistribution;
    live.residual = options.residual;
    return live;
}

LeakyOptions leaky_options(const PlayOptions& options, const std::vector<std::uint32_t>& movers)
{
    LeakyOptions leaky;
    leaky.atlas = options.atlas;
    leaky.solver = std::get<DirectionsOptions>(options.solver);
    leaky.leak = options.leak;
    leaky.movers = movers;
    leaky.still = movers.empty();
    leaky.residual = options.residual;
    return leaky;
}

/// Light by a scene on the device: LiveScene or LeakyScene.
template <class Live>
class DeviceLight final : public PlayedLight {
public:
    template <class Options>
    DeviceLight(const gpu::Device& device, const Scene& start, const Animation& animation,
                const std::vector<std::uint32_t>& movers, const Options& options)
        : movers_(movers),
          lamps_(changing_lamps(start, animation)),
          live_(device, (check_lamps(start, lamps_), at_its_brightest(start, animation)), options)
    {
    }

    void change_to(const Scene& shown, double time) override
    {
        for (const std::uint32_t i : movers_)
            live_.move(i, shown.instances[i].transform);
        for (ChangingLamp& lamp : lamps_) {
            const glm::vec3 factor = emission_factor(*lamp.material, time);
            if (factor != lamp.factor)
                live_.set_emission(lamp.instance, factor);
            lamp.factor = factor;
        }
    }
    void update(double budget_ms, FrameRow& row) override
    {
        const LiveState state = live_.update(budget_ms);
        row.update_ms += state.milliseconds;
        row.residual = state.residual;
        row.at_rest = state.at_rest;
        row.hemicubes += state.hemicubes - hemicubes_;
        hemicubes_ = state.hemicubes;
    }
    std::vector<glm::vec3> irradiance() override { return live_.irradiance(); }

    std::uint64_t shots() const override { return hemicubes_; }
    const Scene& scene() const override { return live_.scene(); }
    const Atlas& atlas() const override { return live_.atlas(); }
    const Lumels& lumels() const override { return live_.lumels(); }
    const gpu::StageTimes& times() const override { return live_.times(); }

private:
    std::vector<std::uint32_t> movers_;
    std::vector<ChangingLamp> lamps_;
    Live live_;
    std::uint64_t hemicubes_ = 0;
};

}  // namespace

glm::vec3 emission_factor(const AnimatedMaterial& material, double time)
{
    const glm::vec3 now = emitted_at(material, time), most = most_emitted(material);
    glm::vec3 factor(0.0f);
    for (int c = 0; c < 3; ++c)
        if (most[c] > 0.0f)
            factor[c] = now[c] / most[c];
    return factor;
}

Scene at_its_brightest(Scene scene, const Animation& animation)
{
    for (const AnimatedMaterial& material : animation.materials)
        scene.materials[std::size_t(material.material)].emitted = most_emitted(material);
    return scene;
}

bool changes_anything(const Scene& start, const Animation& animation)
{
    return !movers_of(animation, start).empty() || !changing_lamps(start, animation).empty();
}

std::unique_ptr<PlayedLight> make_played_light(const gpu::Device& device, const Scene& start,
                                               const Animation& animation,
                                               const PlayOptions& options)
{
    const std::vector<std::uint32_t> movers = movers_of(animation, start);
    if (std::holds_alternative<LinksOptions>(options.solver))
        return std::make_unique<LinksLight>(start, animation, options);
    if (std::holds_alternative<DirectionsOptions>(options.solver))
        return std::make_unique<DeviceLight<LeakyScene>>(device, start, animation, movers,
                                                         leaky_options(options, movers));
    return std::make_unique<DeviceLight<LiveScene>>(device, start, animation, movers,
                                                    live_options(options, movers));
}

}  // namespace lumel
