// Each solver and the path tracer on the same atlas in one run, error against processor time and
// wall time.

#include "bench/modes.h"

#include <cmath>
#include <cstdio>
#include <optional>

#include <fmt/core.h>

#include "bake/lighting.h"
#include "bake/setting.h"
#include "bench/reference.h"
#include "bench/stopwatch.h"
#include "finish/finish.h"
#include "reference/metrics.h"
#include "reference/reference.h"
#include "shooting/lumel_arrays.h"
#include "solve/solver.h"

namespace lumel::bench {
namespace {

struct Row {
    double cpu, error;
};

void print_head()
{
    fmt::print("{:<22} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9}\n", "method", "samples", "cpu [s]",
               "wall [s]", "RMSE %", "bias %", "estimate %");
}

Row print_row(const std::string& method, std::uint64_t samples, const Stopwatch& watch,
              const std::optional<MapError>& error, double estimate)
{
    const std::string measured =
        error ? fmt::format("{:>9.2f} {:>+8.2f}", 100.0 * error->relative_rmse, 100.0 * error->bias)
              : fmt::format("{:>9} {:>8}", "-", "-");
    fmt::print("{:<22} {:>9} {:>9.2f} {:>9.2f} {} {:>9}\n", method, samples, watch.cpu, watch.wall,
               measured,
               estimate < 0.0 ? std::string("-") : fmt::format("{:.2f}", 100.0 * estimate));
    std::fflush(stdout);
    return {watch.cpu, error ? error->relative_rmse : 0.0};
}

std::optional<MapError> error_of(const Prepared& world, const std::vector<glm::vec3>& irradiance,
                                 const std::optional<Image>& reference)
{
    if (!reference)
        return {};
    return compare_maps(finish_map(world.scene, world.atlas, world.lumels, irradiance), *reference);
}

/// Processor time at which the error falls to `target`, by interpolation in log-log; the last
/// two rows are extended where none is below it.
double time_to(const std::vector<Row>& rows, double target)
{
    if (rows.size() < 2)
        return rows.empty() ? 0.0 : rows[0].cpu * std::pow(rows[0].error / target, 2.0);
    std::size_t i = 1;
    while (i + 1 < rows.size() && rows[i].error > target)
        ++i;
    const Row &a = rows[i - 1], &b = rows[i];
    const double slope = std::log(b.cpu / a.cpu) / std::log(b.error / a.error);
    return a.cpu * std::pow(target / a.error, slope);
}

std::vector<Row> race_path_tracer(const Settings& settings, const Prepared& world,
                                  const std::optional<Image>& reference)
{
    std::vector<Row> rows;
    for (const int spp : settings.spp) {
        Stopwatch watch;
        watch.start();
        const auto irradiance = reference_irradiance(world.scene, world.rays, world.lumels,
                                                     {.samples_per_lumel = spp,
                                                      .seed = 7 + seed_of(settings.given.options()),
                                                      .rule = rule_of(settings.given.options())});
        watch.stop();
        rows.push_back(print_row("path tracer (Embree)", std::uint64_t(spp), watch,
                                 error_of(world, irradiance, reference), -1.0));
    }
    return rows;
}

/// What sky and lamps send straight to the lumels [N] [lx]; empty if there are none.
std::vector<glm::vec3> light_of(const Settings& settings, const gpu::Device& device,
                                const World& world, const Prepared& prepared)
{
    if (!has_lights(prepared.scene) || method_of(settings.given.id).finds_lights)
        return {};
    return direct_light(device, world, prepared.scene, prepared.lumels,
                        direct_light_options(solver_of(settings), settings.sky_directions))
        .irradiance;
}

std::vector<Row> race_solver(const Settings& settings, const Prepared& world,
                             const std::optional<Image>& reference)
{
    const SolverOptions options = solver_of(settings);
    const gpu::Device device(settings.device);
    fmt::print("device: {} ({})\n", device.info().name, device.info().driver);
    {  // The driver compiles shaders when they first run; it keeps them for the next time.
        const World warm(device, world.scene, world.lumels, &world.atlas);
        Settings few = settings;
        few.sky_directions = 2;
        light_of(few, device, warm, world);
        const HostScene host{world.scene, world.rays, world.atlas};
        const NearField none{.first = std::vector<std::uint32_t>(world.lumels.lumels.size() + 1)};
        const auto solver = make_solver(
            {.device = device, .world = &warm, .lumels = world.lumels, .near = none, .host = &host},
            options);
        for (int i = 0; i < 8; ++i)
            solver->step();
        solver->irradiance();
    }
    print_head();
    Stopwatch watch;
    watch.start();
    const NearField near =
        near_field_for(world.scene, world.rays, world.lumels, options, settings.near_radius);
    const World gpu_world(device, world.scene, world.lumels, &world.atlas);
    watch.stop();
    fmt::print("# near field: {} pairs; set-up {:.2f} cpu-s\n", near.column.size(), watch.cpu);
    watch.start();
    const double before = watch.cpu;
    const std::vector<glm::vec3> direct = light_of(settings, device, gpu_world, world);
    const std::optional<Lumels> lit = shining(world.lumels, direct);
    const HostScene host{world.scene, world.rays, world.atlas};
    const std::optional<LobeParticles> particles = particles_for(world, options);
    const auto solver = make_solver({.device = device,
                                     .world = &gpu_world,
                                     .lumels = lit ? *lit : world.lumels,
                                     .near = near,
                                     .particles = particles ? &*particles : nullptr,
                                     .host = &host},
                                    options);
    watch.stop();
    fmt::print("# sky and lamps {:.2f} cpu-s\n", watch.cpu - before);
    std::vector<Row> rows;
    for (const std::uint64_t shots : settings.shots) {
        watch.start();
        while (solver->state().shots < shots)
            solver->step();
        std::vector<glm::vec3> irradiance = solver->irradiance();
        add_light(irradiance, direct);
        watch.stop();
        rows.push_back(print_row(settings.given.id, solver->state().shots, watch,
                                 error_of(world, irradiance, reference), solver->state().error));
    }
    for (const auto& [stage, ms] : solver->times())
        fmt::print("#   {:<12} {:>9.1f} ms\n", stage, ms);
    fmt::print("#   longest submission {:.1f} ms, memory at most {:.0f} MB\n",
               solver->longest_submission(), 1e-6 * double(peak_memory_bytes()));
    device.check_validation();
    return rows;
}

}  // namespace

void race(const Settings& settings)
{
    const Prepared world = prepare(settings, settings.size);
    fmt::print("{}: {} lumels at {}², {} triangles drawn\n", settings.scene,
               world.lumels.lumels.size(), world.atlas.width,
               find_occluders(world.scene).inner_indices().size() / 3);
    const std::optional<Image> reference = reference_map(settings, world);
    const std::vector<Row> ours = race_solver(settings, world, reference);
    const std::vector<Row> theirs = race_path_tracer(settings, world, reference);
    if (!reference || ours.empty() || theirs.empty())
        return;
    const double mine = time_to(ours, settings.target), other = time_to(theirs, settings.target);
    fmt::print("to {:.1f} %: {} {:.2f} cpu-s, path tracer {:.2f} cpu-s, ratio {:.3f}\n",
               100.0 * settings.target, settings.given.id, mine, other, mine / other);
}

}  // namespace lumel::bench
