// Methods and their competitors on the same atlas in one run, error against processor time and
// wall time. Charts, lumels and the tree of rays are made before, for all.

#include "bench/modes.h"

#include <optional>

#include <fmt/core.h>

#include "bench/iterated_gather.h"
#include "bench/scores.h"
#include "bench/stopwatch.h"
#include "bench/truth.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/setting.h"
#include "solve/shooting/lumel_arrays.h"
#include "solve/solver/solver.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

/// Steps before timing starts.
constexpr int kWarmUpSteps = 8;

/// Each row traces its paths anew, as `lumel reference` does: they are stratified as a whole.
void race_path_tracer(const Settings& settings, const SolveScene& world, Score& score)
{
    const MethodOptions given = settings.given.options();
    double cost = 0.0;  // of a sample
    for (const int spp : settings.spp) {
        if (score.has_ended() || !score.can_afford(cost * spp))
            return;
        Stopwatch watch;
        watch.start();
        const auto light = reference_irradiance(
            world.scene, world.rays, world.lumels,
            {.samples_per_lumel = spp, .seed = seed_of(given), .rule = rule_of(given)});
        watch.stop();
        cost = watch.cpu / spp;
        score.add_row({.samples = std::uint64_t(spp)}, watch, light);
    }
}

void race_iterated_gather(const Settings& settings, const SolveScene& world, Score& score)
{
    const MethodOptions given = settings.given.options();
    Stopwatch watch;
    watch.start();
    IteratedGather gather(world, rule_of(given), seed_of(given));
    watch.stop();
    for (const int spp : settings.spp) {
        if (score.has_ended())
            return;
        watch.start();
        while (gather.rays() < std::uint32_t(spp))
            gather.pass();
        const std::vector<glm::vec3> light = gather.irradiance();
        watch.stop();
        score.add_row({.samples = gather.rays()}, watch, light);
    }
}

/// What sky and lamps send straight to the lumels [N] [lx]; empty if there are none.
std::vector<glm::vec3> light_of(const Settings& settings, const gpu::Device& device,
                                const World& world, const SolveScene& prepared)
{
    if (!has_lights(prepared.scene) || method_of(settings.given.id).finds_lights)
        return {};
    return direct_light(device, world, prepared.scene, prepared.lumels,
                        direct_light_options(solver_of(settings), settings.sky_directions))
        .irradiance;
}

/// The driver compiles shaders when they first run; it keeps them for the next time.
void warm_up(const Settings& settings, const gpu::Device& device, const SolveScene& world)
{
    const World warm(device, world.scene, world.lumels, &world.atlas);
    Settings few = settings;
    few.sky_directions = 2;
    light_of(few, device, warm, world);
    const NearField none{.first = std::vector<std::uint32_t>(world.lumels.lumels.size() + 1)};
    const auto solver = make_solver(
        {.device = &device, .world = &warm, .lumels = world.lumels, .near = none, .scene = &world},
        solver_of(settings));
    for (int i = 0; i < kWarmUpSteps; ++i)
        solver->step();
    solver->irradiance();
}

void add_rows(const Settings& settings, const std::vector<glm::vec3>& direct, Solver& solver,
              Stopwatch& watch, Score& score)
{
    std::uint64_t before = 0;
    for (const std::uint64_t shots : settings.shots) {
        if (score.has_ended())
            return;
        while (solver.state().shots < shots && watch.cpu < settings.seconds) {
            watch.start();
            solver.step();
            watch.stop();
        }
        const SolverState state = solver.state();
        if (state.shots == before)
            continue;  // one step went past several rows, or time was up
        before = state.shots;
        watch.start();
        std::vector<glm::vec3> light = solver.irradiance();
        add_light(light, direct);
        watch.stop();
        score.add_row({state.shots, state.error, state.dark_error}, watch, light);
    }
}

void race_solver(const Settings& settings, const SolveScene& world, Score& score)
{
    const SolverOptions options = solver_of(settings);
    const gpu::Device device(settings.device);
    const bool on_device = method_of(options.method).on_device;
    if (on_device)
        warm_up(settings, device, world);
    Stopwatch watch;
    watch.start();
    const NearField near =
        near_field_for(world.scene, world.rays, world.lumels, options, settings.near_radius);
    std::optional<World> gpu_world;
    if (on_device)
        gpu_world.emplace(device, world.scene, world.lumels, &world.atlas);
    watch.stop();
    const double set_up = watch.cpu;
    watch.start();
    const std::vector<glm::vec3> direct =
        on_device ? light_of(settings, device, *gpu_world, world) : std::vector<glm::vec3>();
    const std::optional<Lumels> lit = shining(world.lumels, direct);
    const std::optional<LobeParticles> particles = particles_for(world, options);
    const auto solver = make_solver({.device = &device,
                                     .world = gpu_world ? &*gpu_world : nullptr,
                                     .lumels = lit ? *lit : world.lumels,
                                     .near = near,
                                     .particles = particles ? &*particles : nullptr,
                                     .scene = &world},
                                    options);
    watch.stop();
    const double start = watch.cpu - set_up;
    add_rows(settings, direct, *solver, watch, score);
    fmt::print(
        "# {} on {} ({}): set-up {:.2f} cpu-s, {} near pairs; sky, lamps and solver {:.2f} cpu-s\n",
        settings.given.id, device.info().name, device.info().driver, set_up, near.column.size(),
        start);
    for (const auto& [stage, ms] : solver->times())
        fmt::print("#   {:<20} {:>9.1f} ms\n", stage, ms);
    fmt::print("#   longest submission {:.1f} ms, memory at most {:.0f} MB\n",
               solver->longest_submission(), 1e-6 * double(peak_memory_bytes()));
    device.check_validation();
}

/// Runs the racer of a name.
Score race_one(const std::string& name, const Settings& settings, const SolveScene& world,
               const std::optional<Truth>& truth)
{
    Score score(name, settings, truth);
    if (name == kPathTracer)
        race_path_tracer(settings_of(settings, first_method(settings)), world, score);
    else if (name == kIteratedGather)
        race_iterated_gather(settings_of(settings, first_method(settings)), world, score);
    else
        race_solver(settings_of(settings, name), world, score);
    return score;
}

}  // namespace

void race(const Settings& settings)
{
    check_racers(settings);
    const Settings first = settings_of(settings, first_method(settings));
    const SolveScene world = prepare(first, settings.size);
    fmt::print("{}: {} lumels at {}², {} triangles drawn\n", settings.scene,
               world.lumels.lumels.size(), world.atlas.width,
               find_occluders(world.scene).inner_indices().size() / 3);
    const std::optional<Truth> truth = find_truth(first, world);
    if (truth)
        fmt::print("{} lumels are open, {} of them dark; noise of the references' mean {:.2f} %\n",
                   truth->count(), truth->dark_count(), 100.0 * truth->noise());
    Score::print_head();
    std::vector<Score> scores;
    for (const std::string& name : settings.racers)
        scores.push_back(race_one(name, settings, world, truth));
    if (!truth)
        return;
    Score::print_times_head(settings);
    for (const Score& score : scores)
        score.print_times();
}

}  // namespace lumel::bench
