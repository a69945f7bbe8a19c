// [Hoef13] chapter 5: how far corrected solutions are from the truth, and what they take.

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>

#include <fmt/core.h>

#include "bench/cut.h"
#include "bench/papers/figures.h"
#include "bench/papers/moving.h"
#include "bench/stopwatch.h"
#include "reference/metrics.h"
#include "reference/reference.h"
#include "solve/solver.h"
#include "transport/patches.h"

namespace lumel::bench {
namespace {

enum Technique { kGather, kProgressive, kIncremental, kCross, kTechniques };
constexpr std::array<const char*, kTechniques> kNames{"gather", "progressive", "incremental",
                                                      "cross"};
constexpr std::uint32_t kReferenceSeed = 99;
constexpr double kLeastShown = 0.1;  ///< of a part's time [ms]

/// What one technique did after the last move.
struct Outcome {
    Update update;
    std::vector<glm::vec3> irradiance;
    std::optional<MapError> from_truth;
    double from_scratch = 0.0;  ///< relative RMSE from `progressive`, with the same lumels
};

struct Results {
    std::string title;
    std::size_t still = 0, moving = 0;  ///< lumels
    std::size_t patches = 0, moving_patches = 0;
    std::size_t vertices = 0, triangles = 0;
    std::array<std::optional<Outcome>, kTechniques> by;
};

/// One scene, the places of its box and how it is laid out.
struct Stage {
    Scene scene;
    std::uint32_t box = 0;
    std::vector<glm::mat4> places;  ///< one after another
    LiveOptions options;
    GatherOptions gather;
};

Stage set(const ThesisScene& which, const DynamicSettings& settings, int pieces)
{
    Stage stage{.scene = read_gltf(which.path)};
    if (pieces > 1)
        stage.scene = cut(stage.scene, pieces);
    stage.box = find_instance(stage.scene, kBox);
    for (int step = 1; step <= settings.steps + 1; ++step)
        stage.places.push_back(turned(stage.scene, stage.box, double(step * settings.degrees)));
    stage.options.atlas.size = which.low_quality ? settings.low_size : settings.shared.size;
    stage.options.solver = options_of<ProgressiveOptions>(settings.shared);
    stage.gather = options_of<GatherOptions>(settings.shared);
    stage.options.movers = {stage.box};
    stage.options.residual = settings.residual;
    return stage;
}

void count(const Stage& stage, const Lumels& lumels, Results& results)
{
    for (const Lumel& lumel : lumels.lumels)
        ++(lumel.instance == stage.box ? results.moving : results.still);
    for (const PatchChart& chart : make_patches(lumels).charts) {
        const bool moves = lumels.lumels[chart.first_lumel].instance == stage.box;
        results.patches += patches_of(chart, 0);
        results.moving_patches += moves ? patches_of(chart, 0) : 0;
    }
    for (const Mesh& mesh : stage.scene.meshes)
        for (const Primitive& primitive : mesh.primitives) {
            results.vertices += primitive.positions.size();
            results.triangles += primitive.indices.size() / 3;
        }
}

/// The solution follows the box from place to place.
Outcome corrected(const gpu::Device& device, const Stage& stage, Redistribution redistribution)
{
    LiveOptions options = stage.options;
    options.redistribution = redistribution;
    LiveScene live(device, stage.scene, options);
    live.settle();
    Outcome outcome;
    for (std::size_t step = 0; step < stage.places.size(); ++step) {
        Update update = update_after_move(live, stage.box, stage.places[step]);
        // The driver compiles shaders in the first.
        if (step <= 1 || update.whole_ms < outcome.update.whole_ms)
            outcome.update = std::move(update);
    }
    outcome.irradiance = live.irradiance();
    return outcome;
}

/// Solved with the box in its last place from the start. Counts the scene too.
Outcome from_scratch(const gpu::Device& device, const Stage& stage, Results& results)
{
    LiveScene fresh(device, stage.scene, stage.options);
    Outcome outcome{.update = update_after_move(fresh, stage.box, stage.places.back())};
    outcome.irradiance = fresh.irradiance();
    count(stage, fresh.lumels(), results);
    return outcome;
}

/// The lumels of `laid_out`, with the box in its last place.
Outcome gathered(const gpu::Device& device, const LiveScene& laid_out, const Stage& stage)
{
    Scene scene = stage.scene;
    scene.instances[stage.box].transform = stage.places.back();
    const SolverOptions options{.method = stage.gather};
    const World world(device, scene, laid_out.lumels(), &laid_out.atlas());
    const auto solver = make_solver({device, &world, laid_out.lumels(), {}}, options);
    Outcome outcome;
    Stopwatch watch;
    watch.start();
    solve(*solver, options);
    outcome.irradiance = solver->irradiance();
    watch.stop();
    outcome.update.alone_ms = outcome.update.whole_ms = 1e3 * watch.wall;
    outcome.update.alone_hemicubes = outcome.update.whole_hemicubes = solver->state().shots;
    outcome.update.alone_stages = outcome.update.stages = solver->times();
    return outcome;
}

void compare(const gpu::Device& device, const Stage& stage, const DynamicSettings& settings,
             Results& results)
{
    const LiveScene laid_out(device, stage.scene, stage.options);
    Scene scene = stage.scene;
    scene.instances[stage.box].transform = stage.places.back();
    const Lumels& lumels = laid_out.lumels();
    std::optional<Image> truth;
    if (settings.shared.reference_spp > 0)
        truth = in_a_row(lumels,
                         reference_irradiance(scene, RayScene(scene), lumels,
                                              {.samples_per_lumel = settings.shared.reference_spp,
                                               .seed = kReferenceSeed}));
    if (settings.gathers)
        results.by[kGather] = gathered(device, laid_out, stage);
    const Image scratch = in_a_row(lumels, results.by[kProgressive]->irradiance);
    for (auto& outcome : results.by) {
        if (!outcome)
            continue;
        const Image row = in_a_row(lumels, outcome->irradiance);
        outcome->from_scratch = compare_maps(row, scratch).relative_rmse;
        if (truth)
            outcome->from_truth = compare_maps(row, *truth);
    }
}

Results measure(const gpu::Device& device, const ThesisScene& which,
                const DynamicSettings& settings, int pieces)
{
    const Stage stage = set(which, settings, pieces);
    Results results{.title = which.title};
    results.by[kIncremental] = corrected(device, stage, Redistribution::incremental);
    results.by[kCross] = corrected(device, stage, Redistribution::cross);
    results.by[kProgressive] = from_scratch(device, stage, results);
    return results;
}

double sum_of(const gpu::StageTimes& stages)
{
    double sum = 0.0;
    for (const auto& [stage, ms] : stages)
        sum += ms;
    return sum;
}

template <class Cell>
void print_table(const std::string& title, const std::vector<Results>& all, const Cell& cell)
{
    fmt::print("\n{}\n\n| |", title);
    std::string rule = "\n|---|";
    for (const Results& results : all) {
        fmt::print(" {} |", results.title);
        rule += "---|";
    }
    fmt::print("{}\n", rule);
    for (int technique = 0; technique < kTechniques; ++technique) {
        if (!all.front().by[technique])
            continue;
        fmt::print("| {} |", kNames[technique]);
        for (const Results& results : all)
            fmt::print(" {} |", cell(*results.by[technique]));
        fmt::print("\n");
    }
    std::fflush(stdout);
}

void print_scenes(const std::vector<Results>& all)
{
    fmt::print("\n| scene | lumels that stay | on the box | patches | on the box, \\|M\\| "
               "| vertices | triangles |\n|---|---|---|---|---|---|---|\n");
    for (const Results& results : all)
        fmt::print("| {} | {} | {} | {} | {} | {} | {} |\n", results.title, results.still,
                   results.moving, results.patches, results.moving_patches, results.vertices,
                   results.triangles);
}

void print_errors(const std::vector<Results>& all)
{
    const auto of_truth = [](const Outcome& o, auto number) {
        return o.from_truth ? fmt::format("{:.5f}", number(*o.from_truth)) : std::string("–");
    };
    print_table("Normalized RMSE from the truth", all, [&](const Outcome& o) {
        return of_truth(o, [](const MapError& e) { return e.normalized_rmse; });
    });
    print_table("Relative RMSE from the truth, %", all, [&](const Outcome& o) {
        return of_truth(o, [](const MapError& e) { return 100.0 * e.relative_rmse; });
    });
    print_table("Relative RMSE from a progressive solution from scratch, %", all,
                [](const Outcome& o) { return fmt::format("{:.3f}", 100.0 * o.from_scratch); });
}

void print_times(const std::vector<Results>& all)
{
    print_table("Time of an update, ms: redistribution alone / until at rest", all,
                [](const Outcome& o) {
                    return fmt::format("{:.0f} / {:.0f}", o.update.alone_ms, o.update.whole_ms);
                });
    print_table("The same of the device", all, [](const Outcome& o) {
        return fmt::format("{:.0f} / {:.0f}", sum_of(o.update.alone_stages),
                           sum_of(o.update.stages));
    });
    print_table(
        "Hemicubes of an update: redistribution alone / until at rest", all, [](const Outcome& o) {
            return fmt::format("{} / {}", o.update.alone_hemicubes, o.update.whole_hemicubes);
        });
}

/// What one scene's techniques spend on each part.
void print_parts(const Results& results, const char* title, const gpu::StageTimes Update::*stages)
{
    fmt::print("\n{}: device time by part, {}, ms\n\n", results.title, title);
    for (int technique = 0; technique < kTechniques; ++technique) {
        if (!results.by[technique])
            continue;
        fmt::print("- {}:", kNames[technique]);
        for (const auto& [stage, ms] : results.by[technique]->update.*stages)
            if (ms >= kLeastShown)
                fmt::print(" {} {:.1f};", stage, ms);
        fmt::print("\n");
    }
}

std::vector<ThesisScene> scenes_of(const DynamicSettings& settings)
{
    std::vector<ThesisScene> scenes;
    for (const ThesisScene& scene : kThesisScenes)
        if (settings.scenes.empty() ||
            std::count(settings.scenes.begin(), settings.scenes.end(), std::string(scene.key)) > 0)
            scenes.push_back(scene);
    return scenes;
}

}  // namespace

void follow_moves(const DynamicSettings& settings)
{
    const gpu::Device device(settings.shared.device);
    const ViewOptions views = options_of<ProgressiveOptions>(settings.shared).views;
    fmt::print("hemicubes of side {}, {} a batch, {} samples per lumel for the truth, {} ({})\n",
               views.hemicube, views.batch, settings.shared.reference_spp, device.info().name,
               device.info().driver);
    std::vector<int> all_pieces{1};
    std::copy_if(settings.pieces.begin(), settings.pieces.end(), std::back_inserter(all_pieces),
                 [](int pieces) { return pieces > 1; });
    for (const int pieces : all_pieces) {
        std::vector<Results> all;
        for (const ThesisScene& scene : scenes_of(settings)) {
            all.push_back(measure(device, scene, settings, pieces));
            if (pieces == 1)
                compare(device, set(scene, settings, pieces), settings, all.back());
        }
        print_scenes(all);
        if (pieces == 1)
            print_errors(all);
        print_times(all);
        for (const Results& results : all) {
            print_parts(results, "redistribution alone", &Update::alone_stages);
            print_parts(results, "until at rest", &Update::stages);
        }
    }
    device.check_validation();
}

}  // namespace lumel::bench
