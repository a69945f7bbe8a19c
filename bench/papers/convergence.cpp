// [BJ04] figures 5 and 6, the scene and its map after 1, 4 and 50 iterations; [BSS05] section 6:
// "we can expect converged images after 40 – 80 iterations".

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/iteration_cost.h"
#include "bench/reference.h"
#include "bench/stopwatch.h"
#include "jobs/render/render.h"
#include "jobs/solve/setting.h"
#include "results/preview/preview.h"
#include "solve/solver/solver.h"
#include "truth/metrics.h"

namespace lumel::bench {
namespace {

/// Places looked at within a pixel, each by some of the shooters.
constexpr int kMaxSets = 4;
/// Along the lobe at each place; the papers have none.
constexpr std::uint32_t kRays = 16;

struct Step {
    int iterations = 0;
    Image map, picture;
};

std::string word_for(const SolverOptions& options)
{
    return is_papers(options.method) ? "paper" : "phased";
}

bool is_glossy(const SolverOptions& options)
{
    return method_of(options.method).materials == MaterialModel::glossy;
}

/// The glossy scene from its camera: of the papers' scheme as the iterations have it, of ours by a
/// number of iterations before the eye looks and as many after.
Image glossy_picture(const ConvergenceSettings& settings, SolverOptions options, int iterations)
{
    options.max_shots = std::uint64_t(iterations) * std::uint64_t(batch_of(options.method));
    options.target_error = 0.0;
    RenderOptions render_options{.width = settings.width,
                                 .sets = std::uint32_t(std::min(iterations, kMaxSets)),
                                 .shots = is_papers(options.method) ? 0u : options.max_shots,
                                 .rays = kRays};
    render_options.bake.atlas.size = settings.shared.size;
    render_options.bake.solver = options;
    render_options.bake.device = settings.shared.device;
    return render(read_gltf(settings.shared.scene, MaterialModel::glossy), render_options).image;
}

Image picture_of(const ConvergenceSettings& settings, const SolverOptions& options,
                 const gpu::Device& device, const SolveScene& world, const Step& step)
{
    if (is_glossy(options))
        return glossy_picture(settings, options, step.iterations);
    return render_preview(device, world.scene, world.atlas, step.map,
                          choose_view(world.scene, world.rays), settings.width);
}

std::string stem_of(const ConvergenceSettings& settings)
{
    return settings.folder + "/" + std::filesystem::path(settings.shared.scene).stem().string();
}

/// All exposed like the last. Returns the pictures.
std::vector<Image> write_steps(const ConvergenceSettings& settings, const SolverOptions& options,
                               const std::vector<Step>& steps)
{
    std::filesystem::create_directories(settings.folder);
    const float map_exposure = choose_exposure(steps.back().map).value_or(1.0f);
    const float picture_exposure = choose_exposure(steps.back().picture).value_or(1.0f);
    std::vector<Image> pictures;
    for (const Step& step : steps) {
        const auto path = [&](const char* what) {
            return fmt::format("{}-{}-{}-{:03}.png", stem_of(settings), word_for(options), what,
                               step.iterations);
        };
        write_png(path("map"), tone_map(step.map, map_exposure));
        pictures.push_back(tone_map(step.picture, picture_exposure));
        write_png(path("picture"), pictures.back());
    }
    return pictures;
}

void add_row(Report& report, const SolverOptions& options, const SolverState& state, double cpu,
             const std::optional<MapError>& error)
{
    report.row({word_for(options), state.iterations, batch_of(options.method), state.shots,
                error ? fixed(100.0 * error->relative_rmse, 2) : none(),
                error ? signed_fixed(100.0 * error->bias, 2) : none(), fixed(cpu, 3)});
}

/// Returns the pictures, none without a folder for them.
std::vector<Image> follow(const ConvergenceSettings& settings, const SolverOptions& options,
                          const gpu::Device& device, const SolveScene& world,
                          const std::optional<Image>& reference, Report& report)
{
    const NearField near = near_field_for(world.scene, world.rays, world.lumels, options);
    const World resident(device, world.scene, world.lumels);
    const std::optional<LobeParticles> particles = particles_for(world, options);
    const SolverInputs inputs{.device = &device,
                              .world = &resident,
                              .lumels = world.lumels,
                              .near = near,
                              .particles = particles ? &*particles : nullptr,
                              .scene = &world};
    {  // the driver compiles shaders when they first run
        const auto warm = make_solver(inputs, options);
        warm->step();
        warm->irradiance();
    }
    const auto solver = make_solver(inputs, options);
    std::vector<Step> steps;
    Stopwatch watch;
    for (const int iterations : settings.iterations) {
        watch.start();
        while (solver->state().iterations < std::uint64_t(iterations))
            solver->step();
        const std::vector<glm::vec3> irradiance = solver->irradiance();
        watch.stop();
        Step step{.iterations = iterations,
                  .map = finish_map(world.scene, world.atlas, world.lumels, irradiance)};
        std::optional<MapError> error;
        if (reference)
            error = compare_maps(step.map, *reference);
        add_row(report, options, solver->state(), watch.cpu, error);
        if (settings.folder.empty())
            continue;
        step.picture = picture_of(settings, options, device, world, step);
        steps.push_back(std::move(step));
    }
    return steps.empty() ? std::vector<Image>() : write_steps(settings, options, steps);
}

}  // namespace

void follow_convergence(const ConvergenceSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const SolveScene world = prepare(settings.shared, settings.shared.size);
    const std::optional<Image> reference = reference_map(settings.shared, world);
    report.say(fmt::format("{}, {}, {} lumels at {}², {}", settings.shared.scene,
                           settings.shared.given.id, world.lumels.lumels.size(), world.atlas.width,
                           words_of(device)));
    report.table("convergence",
                 "Error after iterations ([BJ04] figures 5 and 6); of the map, relative, against "
                 "paths",
                 {"scheme", "iterations", "K", "shooters", "RMSE %", "bias %", "cpu s"});
    const std::vector<std::vector<Image>> rows{
        follow(settings, papers_iteration(settings.shared.given.options()), device, world,
               reference, report),
        follow(settings, solver_of(settings.shared), device, world, reference, report)};
    if (!settings.folder.empty()) {
        const std::string sheet = stem_of(settings) + "-pictures.png";
        write_png(sheet, contact_sheet(rows));
        report.picture(sheet, settings.shared.scene +
                                  ": above the papers' scheme, below the default, after the "
                                  "iterations of the table");
    }
    device.check_validation();
}

}  // namespace lumel::bench
