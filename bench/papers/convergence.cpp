// [BJ04] figures 5 and 6, the scene and its map after 1, 4 and 50 iterations; [BSS05] section 6:
// "we can expect converged images after 40 – 80 iterations".
//
// Each paper by its own iteration, from and to the centres of texels: [BJ04] Eq. (2), in which T*
// acts on the running average, through a hemisphere; [BSS05] Eqs. (4) and (5), in which it acts on
// the last value, with the merged texels of Eq. (8), through a hemicube.

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "base/images/image_files.h"
#include "bench/papers/contact_sheet.h"
#include "bench/papers/figures.h"
#include "bench/papers/halves.h"
#include "bench/papers/iteration_cost.h"
#include "bench/papers/our_default.h"
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
    Image map;        ///< H
    Image radiosity;  ///< E + ρH: what the papers' textures hold
    Image picture;
};

/// An iteration that is followed.
struct Course {
    std::string name;  ///< in the table
    std::string word;  ///< in names of files
    SolverOptions options;
};

bool is_glossy(const Settings& settings)
{
    return method_of(settings.given.id).materials == MaterialModel::glossy;
}

/// The papers' that solve the scene's materials, and the default of the method that is given.
std::vector<Course> courses_of(const Settings& settings)
{
    std::vector<Course> courses;
    if (!is_glossy(settings)) {
        auto own = options_of<StochasticOptions>(settings);
        if (settings.given.values.count("projection") == 0)
            own.views.projection = Projection::hemisphere;
        courses.push_back({"[BJ04]", "bj04", papers_iteration(own)});
    }
    courses.push_back({"[BSS05]", "bss05", papers_iteration(options_of<GlossyOptions>(settings))});
    courses.push_back({"default", "default", solver_of(settings)});
    return courses;
}

/// Diffuse surfaces as a glossy method sees them.
void leave_out_lobes(Lumels& lumels)
{
    for (std::size_t i = 0; i < lumels.gloss.size(); ++i)
        lumels.gloss[i] = {lumels.lumels[i].albedo, glm::vec3(0.0f), 1.0f};
}

/// Two independent halves of the truth, or one that is given; none if nothing is compared.
std::vector<Image> truths(const Settings& settings, const SolveScene& world)
{
    std::vector<Image> maps;
    for (const std::uint32_t half : {0u, 1u})
        if (maps.size() == half && (half == 0 || settings.reference.empty()))
            if (std::optional<Image> map = reference_map(settings, world, half))
                maps.push_back(std::move(*map));
    return maps;
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
    if (is_glossy(settings.shared))
        return glossy_picture(settings, options, step.iterations);
    return render_preview(device, world.scene, world.atlas, step.map,
                          choose_view(world.scene, world.rays), settings.width);
}

std::string stem_of(const ConvergenceSettings& settings)
{
    return settings.folder + "/" + std::filesystem::path(settings.shared.scene).stem().string();
}

/// Maps and pictures of one course.
struct Row {
    std::vector<Image> maps, pictures;
};

/// All exposed like the last.
Row write_steps(const ConvergenceSettings& settings, const std::string& word,
                const std::vector<Step>& steps)
{
    std::filesystem::create_directories(settings.folder);
    const float map_exposure = choose_exposure(steps.back().radiosity).value_or(1.0f);
    const float picture_exposure = choose_exposure(steps.back().picture).value_or(1.0f);
    Row row;
    for (const Step& step : steps) {
        const auto path = [&](const char* what) {
            return fmt::format("{}-{}-{}-{:03}.png", stem_of(settings), word, what,
                               step.iterations);
        };
        row.maps.push_back(tone_map(step.radiosity, map_exposure));
        write_png(path("map"), row.maps.back());
        row.pictures.push_back(tone_map(step.picture, picture_exposure));
        write_png(path("picture"), row.pictures.back());
    }
    return row;
}

/// E + ρH [N] [lm/m²]
std::vector<glm::vec3> radiosity_of(const Lumels& lumels, std::vector<glm::vec3> irradiance)
{
    for (std::size_t i = 0; i < irradiance.size(); ++i)
        irradiance[i] = lumels.lumels[i].emission + lumels.lumels[i].albedo * irradiance[i];
    return irradiance;
}

Cell by_our_default(const gpu::Device& device, const SolveScene& world,
                    const std::vector<Image>& truth)
{
    if (truth.empty())
        return none();
    const Solved ours = solve_by_default(device, world);
    return words_of(error_of(map_of(world, ours), truth).relative_rmse, ours.cpu);
}

void add_row(Report& report, const Course& course, const SolverState& state, double cpu,
             const std::optional<MapError>& error)
{
    report.row({course.name, state.iterations, batch_of(course.options.method), state.shots,
                error ? fixed(100.0 * error->relative_rmse, 2) : none(),
                error ? signed_fixed(100.0 * error->bias, 2) : none(), fixed(cpu, 3)});
}

/// Nothing is shown without a folder.
Row follow(const ConvergenceSettings& settings, const Course& course, const gpu::Device& device,
           const SolveScene& world, const std::vector<Image>& truth, Report& report)
{
    const SolverOptions& options = course.options;
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
        if (!truth.empty())
            error = error_of(step.map, truth);
        add_row(report, course, solver->state(), watch.cpu, error);
        if (settings.folder.empty())
            continue;
        step.radiosity = finish_map(world.scene, world.atlas, world.lumels,
                                    radiosity_of(world.lumels, irradiance));
        step.picture = picture_of(settings, options, device, world, step);
        steps.push_back(std::move(step));
    }
    return steps.empty() ? Row() : write_steps(settings, course.word, steps);
}

}  // namespace

void follow_convergence(const ConvergenceSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    SolveScene world = prepare(settings.shared, settings.shared.size);
    if (!is_glossy(settings.shared))
        leave_out_lobes(world.lumels);
    const std::vector<Image> truth = truths(settings.shared, world);
    report.say(fmt::format("{}, {}, {} lumels at {}², {}", settings.shared.scene,
                           settings.shared.given.id, world.lumels.lumels.size(), world.atlas.width,
                           words_of(device)));
    report.table("convergence",
                 "Error after iterations ([BJ04] figures 5 and 6); of the map, relative, against "
                 "paths, free of their noise",
                 {"scheme", "iterations", "K", "shooters", "RMSE %", "bias %", "cpu s"},
                 by_our_default(device, world, truth));
    std::vector<std::vector<Image>> maps, pictures;
    std::string names;
    for (const Course& course : courses_of(settings.shared)) {
        Row row = follow(settings, course, device, world, truth, report);
        maps.push_back(std::move(row.maps));
        pictures.push_back(std::move(row.pictures));
        names += (names.empty() ? "" : ", ") + course.name;
    }
    if (!settings.folder.empty()) {
        const auto show = [&](const char* what, const std::vector<std::vector<Image>>& rows,
                              const char* figure) {
            const std::string sheet = stem_of(settings) + "-" + what + ".png";
            write_png(sheet, contact_sheet(rows));
            report.picture(sheet, fmt::format("{}, {}{}: from above by {}, after the iterations of "
                                              "the table",
                                              settings.shared.scene, what, figure, names));
        };
        show("maps", maps, " of radiosity ([BJ04] figures 4 and 6)");
        show("pictures", pictures, " ([BJ04] figure 5)");
    }
    device.check_validation();
}

}  // namespace lumel::bench
