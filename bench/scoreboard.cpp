// The scoreboard: each solver and the path tracer on the same atlas in one run, error against
// processor time and wall time.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/core.h>

#include "bake/prepare.h"
#include "core/usage.h"
#include "finish/finish.h"
#include "output/image_files.h"
#include "reference/metrics.h"
#include "solve/solver.h"

namespace {

using namespace lumel;

struct Settings {
    std::string scene = "scenes/cornell-box.gltf";
    int size = 128;
    std::string reference;  ///< EXR made by `lumel reference` with the same atlas; empty: made here
    int reference_spp = 4096;
    std::string save_reference;  ///< EXR to keep the reference in
    std::vector<std::uint64_t> shots{256, 512, 1024, 2048, 4096, 8192};
    std::vector<int> spp{16, 64, 256};
    SolverOptions solver;
    std::string scheme = "phased", sampling = "area", device;
    float near_radius = NearFieldOptions{}.radius;
    double target = 0.02;  ///< relative RMSE that the methods race to
};

/// Processor and wall time of what ran between start() and stop(), added up.
class Stopwatch {
public:
    void start()
    {
        cpu_start_ = cpu_seconds();
        wall_start_ = wall_seconds();
    }
    void stop()
    {
        cpu += cpu_seconds() - cpu_start_;
        wall += wall_seconds() - wall_start_;
    }
    double cpu = 0.0, wall = 0.0;

private:
    double cpu_start_ = 0.0, wall_start_ = 0.0;
};

struct Row {
    double cpu, error;
};

void print_head()
{
    fmt::print("{:<22} {:>9} {:>9} {:>9} {:>9} {:>8} {:>9}\n", "method", "samples", "cpu [s]",
               "wall [s]", "RMSE %", "bias %", "estimate %");
}

Row print_row(const std::string& method, std::uint64_t samples, const Stopwatch& watch,
              const MapError& error, double estimate)
{
    fmt::print("{:<22} {:>9} {:>9.2f} {:>9.2f} {:>9.2f} {:>+8.2f} {:>9}\n", method, samples,
               watch.cpu, watch.wall, 100.0 * error.relative_rmse, 100.0 * error.bias,
               estimate < 0.0 ? std::string("-") : fmt::format("{:.2f}", 100.0 * estimate));
    std::fflush(stdout);
    return {watch.cpu, error.relative_rmse};
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
                                  const Image& reference)
{
    std::vector<Row> rows;
    for (const int spp : settings.spp) {
        Stopwatch watch;
        watch.start();
        const auto irradiance = reference_irradiance(world.scene, world.rays, world.lumels,
                                                     {.samples_per_lumel = spp,
                                                      .seed = 7 + settings.solver.seed,
                                                      .rule = settings.solver.rule});
        watch.stop();
        rows.push_back(print_row(
            "path tracer (Embree)", std::uint64_t(spp), watch,
            compare_maps(finish_map(world.scene, world.atlas, world.lumels, irradiance), reference),
            -1.0));
    }
    return rows;
}

std::vector<Row> race_solver(const Settings& settings, const Prepared& world,
                             const Image& reference)
{
    const gpu::Device device(settings.device);
    fmt::print("device: {} ({})\n", device.info().name, device.info().driver);
    {  // The driver compiles shaders when they first run; it keeps them for the next time.
        const World warm(device, world.scene, world.lumels);
        const auto solver = make_solver(
            device, warm, world.lumels,
            {.first = std::vector<std::uint32_t>(world.lumels.lumels.size() + 1)}, settings.solver);
        for (int i = 0; i < 8; ++i)
            solver->step();
        solver->irradiance();
    }
    print_head();
    Stopwatch watch;
    watch.start();
    NearFieldOptions near_options = near_field_options(settings.solver);
    near_options.radius = settings.near_radius;
    const NearField near = build_near_field(world.scene, world.rays, world.lumels, near_options);
    const World gpu_world(device, world.scene, world.lumels);
    const auto solver = make_solver(device, gpu_world, world.lumels, near, settings.solver);
    watch.stop();
    fmt::print("# near field: {} pairs; set-up {:.2f} cpu-s\n", near.column.size(), watch.cpu);
    std::vector<Row> rows;
    for (const std::uint64_t shots : settings.shots) {
        watch.start();
        while (solver->state().shots < shots)
            solver->step();
        const auto irradiance = solver->irradiance();
        watch.stop();
        rows.push_back(print_row(
            settings.solver.method, solver->state().shots, watch,
            compare_maps(finish_map(world.scene, world.atlas, world.lumels, irradiance), reference),
            solver->state().error));
    }
    for (const auto& [stage, ms] : solver->times())
        fmt::print("#   {:<12} {:>9.1f} ms\n", stage, ms);
    fmt::print("#   longest submission {:.1f} ms\n", solver->longest_submission());
    if (!device.validation_messages().empty())
        throw Error(ErrorKind::device, "validation", device.validation_messages());
    return rows;
}

Image reference_map(const Settings& settings, const Prepared& world)
{
    if (!settings.reference.empty())
        return read_exr(settings.reference);
    fmt::print("reference: path tracing {} samples per lumel …\n", settings.reference_spp);
    std::fflush(stdout);
    const Image map = finish_map(world.scene, world.atlas, world.lumels,
                                 reference_irradiance(world.scene, world.rays, world.lumels,
                                                      {.samples_per_lumel = settings.reference_spp,
                                                       .seed = 99,
                                                       .rule = settings.solver.rule}));
    if (!settings.save_reference.empty())
        write_exr(settings.save_reference, map, Precision::float32, {});
    return map;
}

void run(const Settings& settings)
{
    const Prepared world(settings.scene, AtlasOptions{.size = settings.size});
    fmt::print("{}: {} lumels at {}², {} triangles drawn\n", settings.scene,
               world.lumels.lumels.size(), world.atlas.width,
               find_occluders(world.scene).indices.size() / 3);
    const Image reference = reference_map(settings, world);
    const std::vector<Row> ours = race_solver(settings, world, reference);
    const std::vector<Row> theirs = race_path_tracer(settings, world, reference);
    if (ours.empty() || theirs.empty())
        return;
    const double mine = time_to(ours, settings.target), other = time_to(theirs, settings.target);
    fmt::print("to {:.1f} %: {} {:.2f} cpu-s, path tracer {:.2f} cpu-s, ratio {:.3f}\n",
               100.0 * settings.target, settings.solver.method, mine, other, mine / other);
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app("Error against time for each method, on the same atlas");
    app.add_option("scene", settings.scene, "glTF scene")->capture_default_str();
    app.add_option("--size", settings.size, "side of the atlas [texels]")->capture_default_str();
    app.add_option("--reference", settings.reference, "EXR to compare with, made for this atlas");
    app.add_option("--reference-spp", settings.reference_spp, "samples of the reference made here")
        ->capture_default_str();
    app.add_option("--save-reference", settings.save_reference, "EXR to keep that reference in");
    app.add_option("--shots", settings.shots, "stops at which a solver is judged")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--spp", settings.spp, "samples per lumel of the path tracer's rows")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--scheme", settings.scheme, "phased or paper")
        ->check(CLI::IsMember({"phased", "paper"}));
    app.add_option("--sampling", settings.sampling, "area or centre")
        ->check(CLI::IsMember({"area", "centre"}));
    app.add_option("--batch", settings.solver.batch, "shooters per iteration")
        ->capture_default_str();
    app.add_option("--hemicube", settings.solver.hemicube, "front face [pixels]")
        ->capture_default_str();
    app.add_option("--near", settings.near_radius, "near field radius [lumel sizes]")
        ->capture_default_str();
    app.add_option("--seed", settings.solver.seed, "")->capture_default_str();
    app.add_option("--device", settings.device, "as lumel devices lists");
    app.add_option("--target", settings.target, "relative RMSE to race to")->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    settings.solver.scheme = settings.scheme == "paper" ? Scheme::paper : Scheme::phased;
    settings.solver.rule = settings.sampling == "centre" ? SampleRule::centre : SampleRule::area;
    try {
        run(settings);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "lumel-bench: {}\n", error.what());
        return 2;
    }
}
