// What edits cost of a scene that is kept lit over links.

#include <algorithm>
#include <cmath>

#include <fmt/core.h>
#include <glm/gtc/matrix_transform.hpp>

#include "base/core/error.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"
#include "links/live/live_links.h"

namespace lumel::bench {
namespace {

/// Times that each edit is made, each a little other than the one before.
constexpr int kTimes = 7;
/// Light still to come at which an edit can be shown, of all lumels and of dark ones.
constexpr double kGood = 0.01;
/// A thing moves by so much of its size at a time, and a sun turns by so much [rad].
constexpr float kStep = 0.15f, kTurn = 0.087f;

/// What is edited: "dim:lamp" and so on.
struct Edit {
    std::string what, name;
};

Edit edit_of(const std::string& text)
{
    const std::size_t colon = text.find(':');
    const Edit edit{text.substr(0, colon),
                    colon == std::string::npos ? "" : text.substr(colon + 1)};
    if (edit.what != "dim" && edit.what != "shift" && edit.what != "paint" && edit.what != "move")
        throw Error(ErrorKind::input, "--edits " + text,
                    "is not one of dim:LAMP, shift:LAMP, paint:MATERIAL and move:THING");
    return edit;
}

/// A lamp's place for the n-th time: a sun turned, another shifted by a twentieth of the scene.
glm::mat4 shifted(const Scene& scene, const std::string& lamp, float extent, int n)
{
    const auto found = std::find_if(scene.lights.begin(), scene.lights.end(),
                                    [&](const PunctualLight& light) { return light.name == lamp; });
    if (found == scene.lights.end())
        throw Error(ErrorKind::input, scene.path, "has no light named \"" + lamp + "\"");
    if (found->kind == PunctualLight::Kind::directional)
        return glm::rotate(glm::mat4(1.0f), kTurn, glm::vec3(0, 0, 1)) * found->transform;
    const float side = n % 2 == 0 ? 1.0f : -1.0f;
    return glm::translate(glm::mat4(1.0f), glm::vec3(0.05f * extent * side, 0.0f, 0.0f)) *
           found->transform;
}

/// Makes an edit for the n-th time; returns what moves have found again.
Moved make(LiveLinks& live, const Edit& edit, const DynamicRayScene& rays, std::size_t thing, int n)
{
    const float wave = float(n + 1) / float(kTimes);
    if (edit.what == "dim")
        live.set_lamp(edit.name, glm::vec3(1.0f - 0.8f * wave));
    else if (edit.what == "paint")
        live.set_albedo(edit.name, glm::vec3(0.1f, 0.3f, 0.7f) * wave);
    else if (edit.what == "shift")
        live.move_lamp(edit.name,
                       shifted(live.scene(), edit.name,
                               glm::distance(rays.still().low(), rays.still().high()), n));
    else {
        const Box& box = rays.box(std::uint32_t(thing));
        const float size = std::max(box.high.x - box.low.x, box.high.z - box.low.z);
        const glm::mat4 shift = glm::translate(
            glm::mat4(1.0f), glm::vec3(kStep * size * float(n % 2 + 1), 0.0f, kStep * size * wave));
        return live.move(edit.name, shift);
    }
    return {};
}

struct Cost {
    double edit, good, rest;  ///< [ms] of the edit; with sweeps until good, and until at rest
    double weigh;             ///< [ms] to make the weights of what is shown
    int good_sweeps, rest_sweeps;
    double links, direct;  ///< share that is found again
};

/// Light that bounces is swept until it is good, then until it rests.
void finish(LiveLinks& live, Stopwatch& watch, Cost& cost)
{
    LiveLinksState state;
    watch.start();
    while (!state.at_rest && (state.residual > kGood || state.dark_residual > kGood))
        state = live.advance(0.0);
    watch.stop();
    cost.good = 1e3 * watch.cpu;
    cost.good_sweeps = state.sweeps;
    watch.start();
    while (!state.at_rest && !state.weighing)
        state = live.advance(0.0);
    watch.stop();
    cost.rest = 1e3 * watch.cpu;
    cost.rest_sweeps = state.sweeps;
    Stopwatch own;
    own.start();
    live.settle();
    own.stop();
    cost.weigh = 1e3 * own.cpu;
}

/// What it costs to show the light, with the filter's weights as they are [ms].
double time_shown(const LiveLinks& live)
{
    Stopwatch watch;
    watch.start();
    for (int n = 0; n < kTimes; ++n)
        live.shown();
    watch.stop();
    return 1e3 * watch.cpu / kTimes;
}

/// RMSE as a part of the mean light.
double error_of(const std::vector<glm::vec3>& light, const std::vector<glm::vec3>& truth)
{
    double squares = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const glm::dvec3 off(light[i] - truth[i]);
        squares += glm::dot(off, off) / 3.0;
        mean += double(truth[i].r + truth[i].g + truth[i].b) / 3.0;
    }
    return std::sqrt(squares * double(light.size())) / mean;
}

/// The error of the solution and of what is shown, against the mean of some of 256 rays each, whose
/// direct light is the same.
void compare(const LiveLinks& live, const SolveScene& laid_out, LiveLinksOptions options,
             std::uint32_t seeds)
{
    const std::vector<glm::vec3> solved = live.irradiance(), shown = live.shown();
    std::vector<glm::vec3> truth(solved.size());
    options.rays = 256;
    options.filter = false;
    for (options.seed = 1; options.seed <= seeds; ++options.seed) {
        LiveLinks one(copy_of(laid_out), options);
        one.settle();
        const std::vector<glm::vec3> light = one.irradiance();
        for (std::size_t i = 0; i < truth.size(); ++i)
            truth[i] += light[i] / float(seeds);
    }
    fmt::print("error of the solution {:.2f} %, of what is shown {:.2f} %\n",
               100.0 * error_of(solved, truth), 100.0 * error_of(shown, truth));
}

Cost median(std::vector<Cost> costs)
{
    std::sort(costs.begin(), costs.end(),
              [](const Cost& a, const Cost& b) { return a.good < b.good; });
    return costs[costs.size() / 2];
}

void print(const std::string& what, const Cost& cost)
{
    fmt::print("{:<24} {:>9.1f} {:>9.1f} {:>7} {:>9.1f} {:>7} {:>9.1f} {:>10.2f} {:>11.1f}\n", what,
               cost.edit, cost.good, cost.good_sweeps, cost.rest, cost.rest_sweeps, cost.weigh,
               100.0 * cost.links, 100.0 * cost.direct);
    std::fflush(stdout);
}

}  // namespace

void time_edits(const Settings& settings)
{
    std::vector<Edit> edits;
    LiveLinksOptions options{.rays = settings.edit_rays};
    for (const std::string& text : settings.edits) {
        edits.push_back(edit_of(text));
        if (edits.back().what == "move")
            options.things.push_back(edits.back().name);
    }
    const std::unique_ptr<SolveScene> laid_out =
        lay_out(scene_of(settings), {.size = settings.size}, options.things);
    Cost first{.links = 1.0, .direct = 1.0};
    Stopwatch watch;
    watch.start();
    LiveLinks live(copy_of(*laid_out), options);
    watch.stop();
    first.edit = 1e3 * watch.cpu;
    finish(live, watch, first);
    fmt::print("{} at {}: {} lumels, {} rays each, {:.0f} MB\n", settings.scene, settings.size,
               live.lumels().lumels.size(), live.links().rays(), 1e-6 * double(live.bytes()));
    fmt::print("{:<24} {:>9} {:>9} {:>7} {:>9} {:>7} {:>9} {:>10} {:>11}\n",
               "processor time [ms] of", "edit", "to 1 %", "sweeps", "to rest", "sweeps", "weights",
               "links [%]", "direct [%]");
    print("all anew", first);
    fmt::print("{:<24} {:>9.1f}\n", "show", time_shown(live));
    if (settings.edit_truth > 0)
        compare(live, *laid_out, options, settings.edit_truth);
    std::vector<std::vector<std::uint32_t>> instances;
    for (const std::string& name : options.things)
        instances.push_back({find_instance(laid_out->scene, name)});
    const DynamicRayScene rays(*laid_out, instances);
    std::size_t thing = 0;
    for (const Edit& edit : edits) {
        std::vector<Cost> costs;
        if (edit.what == "paint")
            make(live, edit, rays, thing, 0);  // the first time finds the material's lumels
        for (int n = 0; n < kTimes; ++n) {
            Cost& cost = costs.emplace_back();
            Stopwatch own;
            own.start();
            const Moved moved = make(live, edit, rays, thing, n);
            own.stop();
            cost.links = double(moved.links.all()) /
                         double(live.lumels().lumels.size() * live.links().rays());
            cost.direct = moved.direct;
            cost.edit = 1e3 * own.cpu;
            finish(live, own, cost);
        }
        print(edit.what + " " + edit.name, median(costs));
        thing += edit.what == "move";
    }
}

}  // namespace lumel::bench
