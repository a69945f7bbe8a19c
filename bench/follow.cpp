// How long a scene's light takes to follow a change: over links that are kept, by redistribution,
// and solved anew.

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/core/error.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"
#include "gpu/device.h"
#include "links/live/live_links.h"
#include "methods/redistribution/live_scene.h"

namespace lumel::bench {
namespace {

using Lights = std::vector<glm::vec3>;

/// Error at which a change is followed, as a part of the mean light at rest.
constexpr double kFollowed = 0.02;
/// What is dimmed sends so much of its light; a thing moves by so much of its size; a sun turns so
/// far [rad]; what opens moves by so much of its size.
constexpr float kDimmed = 0.4f, kStep = 0.15f, kTurn = 0.087f, kOpened = 1.1f;
/// Light is looked at again after so many times as long: looking takes memory.
constexpr double kNextLook = 1.05;

struct Change {
    std::string what, name;
};

Change change_of(const std::string& text)
{
    const std::size_t colon = text.find(':');
    const Change change{text.substr(0, colon),
                        colon == std::string::npos ? "" : text.substr(colon + 1)};
    if (change.what != "dim" && change.what != "shift" && change.what != "move" &&
        change.what != "open")
        throw Error(ErrorKind::input, "--follow " + text,
                    "is not one of dim:LAMP, shift:LAMP, move:THING and open:THING");
    return change;
}

bool is_move(const Change& change)
{
    return change.what == "move" || change.what == "open";
}

std::optional<std::uint32_t> light_named(const Scene& scene, const std::string& name)
{
    for (std::uint32_t l = 0; l < scene.lights.size(); ++l)
        if (scene.lights[l].name == name)
            return l;
    return {};
}

/// Where a thing goes, along the longer of its horizontal sides.
glm::mat4 motion_of(const Scene& scene, const Change& change)
{
    const std::uint32_t thing = find_instance(scene, change.name);
    const RayScene alone(scene, std::span(&thing, 1));
    const glm::vec3 size = alone.high() - alone.low();
    const float way = (change.what == "open" ? kOpened : kStep) * std::max(size.x, size.z);
    return glm::translate(glm::mat4(1.0f), size.x > size.z ? glm::vec3(way, 0.0f, 0.0f)
                                                           : glm::vec3(0.0f, 0.0f, way));
}

/// The sun turned, another lamp shifted by a twentieth of the scene.
glm::mat4 shifted(const Scene& scene, std::uint32_t light)
{
    const PunctualLight& lamp = scene.lights[light];
    if (lamp.kind == PunctualLight::Kind::directional)
        return glm::rotate(glm::mat4(1.0f), kTurn, glm::vec3(0, 0, 1)) * lamp.transform;
    const RayScene all(scene);
    const float way = 0.05f * glm::distance(all.low(), all.high());
    return glm::translate(glm::mat4(1.0f), glm::vec3(way, 0.0f, 0.0f)) * lamp.transform;
}

/// The light at some processor time since a change [s].
struct Look {
    double seconds;
    Lights light;
};

/// What a change took [s of processor time]; < 0: longer than was allowed.
struct Times {
    double first = -1.0, followed = -1.0, rest = -1.0;
};

double error_of(const Lights& light, const Lights& rest)
{
    double squares = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 off(light[i] - rest[i]);
        squares += glm::dot(off, off) / 3.0;
        mean += double(rest[i].r + rest[i].g + rest[i].b) / 3.0;
    }
    return mean > 0.0 ? std::sqrt(squares * double(light.size())) / mean : 0.0;
}

/// Works step by step until at rest, or for too long, and looks at the light now and then.
Times follow(const Lights& before, const std::function<void()>& change,
             const std::function<bool()>& step, const std::function<Lights()>& light,
             double most_seconds)
{
    Stopwatch watch;
    watch.start();
    change();
    watch.stop();
    std::vector<Look> looks;
    Times times;
    bool rests = false;
    double next = 0.0;
    while (!rests && watch.cpu < most_seconds) {
        watch.start();
        rests = step();
        watch.stop();
        if (!rests && watch.cpu < next)
            continue;
        next = kNextLook * watch.cpu;
        Lights now = light();
        if (times.first < 0.0 && now != before)
            times.first = watch.cpu;
        if (times.first >= 0.0)
            looks.push_back({watch.cpu, std::move(now)});
    }
    if (!rests || looks.empty())
        return times;
    times.rest = watch.cpu;
    for (std::size_t n = looks.size(); n-- > 0;) {
        if (error_of(looks[n].light, looks.back().light) > kFollowed)
            break;
        times.followed = looks[n].seconds;
    }
    return times;
}

void print(const std::string& what, const std::string& by, const Times& times,
           const std::string& links = {})
{
    const auto ms = [](double seconds) {
        return seconds < 0.0 ? std::string("-") : fmt::format("{:.1f}", 1e3 * seconds);
    };
    fmt::print("{:<22} {:<12} {:>10} {:>10} {:>10} {:>10}\n", what, by, ms(times.first),
               ms(times.followed), ms(times.rest), links);
    std::fflush(stdout);
}

void over_links(const Settings& settings, const std::vector<Change>& changes)
{
    LiveLinksOptions options{.rays = settings.edit_rays, .filter = false};
    for (const Change& change : changes)
        if (is_move(change))
            options.things.push_back(change.name);
    std::unique_ptr<SolveScene> laid_out =
        lay_out(scene_of(settings), {.size = settings.size}, options.things);
    const Scene scene = laid_out->scene;
    std::optional<LiveLinks> live;
    const auto light = [&] { return live->irradiance(); };
    const auto step = [&] { return live->advance(0.0).at_rest; };
    const Times all = follow(
        {}, [&] { live.emplace(std::move(laid_out), options); }, step, light, settings.seconds);
    fmt::print("{} lumels\n", live->lumels().lumels.size());
    print("all anew", "links", all, "100");
    for (const Change& change : changes) {
        const std::uint64_t before = live->state().found.links.all();
        const auto make = [&] {
            if (is_move(change)) {
                const auto thing =
                    std::find(options.things.begin(), options.things.end(), change.name);
                live->request(std::uint32_t(thing - options.things.begin()),
                              motion_of(scene, change));
            } else if (change.what == "dim") {
                live->set_lamp(change.name, glm::vec3(kDimmed));
            } else {
                const auto lamp = light_named(scene, change.name);
                if (!lamp)
                    throw Error(ErrorKind::input, scene.path,
                                "has no light named \"" + change.name + "\"");
                live->move_light(*lamp, shifted(scene, *lamp));
            }
        };
        const Times times = follow(light(), make, step, light, settings.seconds);
        const double count = double(live->lumels().lumels.size()) * double(live->links().rays());
        print(change.what + " " + change.name, "links", times,
              fmt::format("{:.2f}",
                          100.0 * double(live->state().found.links.all() - before) / count));
    }
}

/// Dims a lamp, or what shines by a material of that name.
void dim(LiveScene& live, const std::string& name)
{
    const Scene& scene = live.scene();
    if (const auto light = light_named(scene, name)) {
        live.set_light(*light, glm::vec3(kDimmed));
        return;
    }
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        for (const Primitive& primitive :
             scene.meshes[std::size_t(scene.instances[i].mesh)].primitives)
            if (scene.materials[std::size_t(primitive.material)].name == name)
                live.set_emission(i, glm::vec3(kDimmed));
}

void by_redistribution(const Settings& settings, const std::vector<Change>& changes,
                       const gpu::Device& device, Redistribution redistribution)
{
    const char* by = redistribution == Redistribution::cross ? "cross" : "incremental";
    Scene scene = scene_of(settings);
    LiveOptions options{.atlas = {.size = settings.size}, .redistribution = redistribution};
    for (const Change& change : changes)
        if (is_move(change))
            options.movers.push_back(find_instance(scene, change.name));
    options.still = options.movers.empty();
    std::optional<LiveScene> live;
    const auto light = [&] { return live->irradiance(); };
    const auto step = [&] { return live->update(0.0).at_rest; };
    const Scene given = scene;
    const Times all = follow(
        {}, [&] { live.emplace(device, std::move(scene), options); }, step, light,
        settings.seconds);
    print("all anew", by, all);
    if (all.rest < 0.0)
        return;
    for (const Change& change : changes) {
        if (change.what == "shift")
            continue;  // lamps stay where they are
        const auto make = [&] {
            if (change.what == "dim")
                dim(*live, change.name);
            else {
                const std::uint32_t thing = find_instance(given, change.name);
                live->move(thing, motion_of(given, change) * given.instances[thing].transform);
            }
        };
        print(change.what + " " + change.name, by,
              follow(light(), make, step, light, settings.seconds));
    }
}

}  // namespace

void time_following(const Settings& settings)
{
    std::vector<Change> changes;
    for (const std::string& text : settings.follow)
        changes.push_back(change_of(text));
    const gpu::Device device(settings.device);
    fmt::print("{} at {}, {}: ", settings.scene, settings.size, device.info().name);
    over_links(settings, changes);
    for (const Redistribution by : {Redistribution::incremental, Redistribution::cross})
        by_redistribution(settings, changes, device, by);
}

}  // namespace lumel::bench
