// [Hoef13] chapter 5: how far corrected solutions are from the truth, and what they take.

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "bench/cut.h"
#include "bench/papers/figures.h"
#include "bench/papers/moving.h"
#include "bench/stopwatch.h"
#include "solve/solver/solver.h"
#include "solve/transport/patches.h"
#include "truth/metrics.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

enum Technique { kNothing, kGather, kProgressive, kIncremental, kCross, kTechniques };
constexpr std::array<const char*, kTechniques> kNames{"nothing done", "gather", "progressive",
                                                      "incremental", "cross"};
constexpr std::uint32_t kReferenceSeed = 99;
constexpr double kMinShown = 0.1;  ///< of a part's time [ms]

/// What one technique did after the last move.
struct MoveOutcome {
    Update update;
    std::vector<glm::vec3> alone, irradiance;  ///< after redistribution alone; at rest
    std::optional<MapError> alone_from_truth, from_truth;
    /// Relative RMSE from `progressive` at rest, with the same lumels.
    double alone_from_scratch = 0.0, from_scratch = 0.0;
    double change_left = 0.0;  ///< from_scratch relative to that of nothing done
};

struct Results {
    std::string title;
    std::size_t still = 0, moving = 0;  ///< lumels
    std::size_t patches = 0, moving_patches = 0;
    std::size_t vertices = 0, triangles = 0;
    std::array<std::optional<MoveOutcome>, kTechniques> by;
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
    if (which.low_quality) {
        stage.options.solver.views.hemicube = settings.low_hemicube;
        stage.options.solver.shooters = std::uint32_t(settings.low_shooters);
    }
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

/// Solved with the box in `place` from the start.
MoveOutcome from_scratch(const gpu::Device& device, const Stage& stage, const glm::mat4& place)
{
    LiveScene fresh(device, stage.scene, stage.options);
    MoveOutcome outcome{.update = update_after_move(fresh, stage.box, place)};
    outcome.alone = outcome.irradiance = fresh.irradiance();
    // There is nothing to redistribute.
    outcome.update.alone_ms = outcome.update.whole_ms;
    outcome.update.alone_cpu_ms = outcome.update.whole_cpu_ms;
    outcome.update.alone_hemicubes = outcome.update.whole_hemicubes;
    outcome.update.alone_stages = outcome.update.stages;
    return outcome;
}

/// Of the moves or solutions after the first, in which the driver compiles shaders: the one whose
/// time, as it is compared, is the median.
MoveOutcome median(const gpu::Device& device, std::vector<MoveOutcome> outcomes)
{
    const auto ms = counts_processor_time(device) ? &Update::whole_cpu_ms : &Update::whole_ms;
    if (outcomes.size() > 1)
        outcomes.erase(outcomes.begin());
    const auto middle = outcomes.begin() + std::ptrdiff_t(outcomes.size() / 2);
    std::ranges::nth_element(outcomes, middle, {},
                             [&](const MoveOutcome& outcome) { return outcome.update.*ms; });
    return std::move(*middle);
}

/// The solution follows the box from place to place.
MoveOutcome corrected(const gpu::Device& device, const Stage& stage, Redistribution redistribution)
{
    LiveOptions options = stage.options;
    options.redistribution = redistribution;
    LiveScene live(device, stage.scene, options);
    live.settle();
    std::vector<MoveOutcome> outcomes;
    for (const glm::mat4& place : stage.places)
        outcomes.push_back({.update = update_after_move(live, stage.box, place)});
    const std::vector<glm::vec3> alone = outcomes.back().update.alone;
    MoveOutcome outcome = median(device, std::move(outcomes));
    outcome.alone = alone;
    outcome.irradiance = live.irradiance();
    return outcome;
}

/// Solved from nothing as often as moves are timed, with the box in its last place.
MoveOutcome from_scratch(const gpu::Device& device, const Stage& stage)
{
    std::vector<MoveOutcome> outcomes;
    for (std::size_t i = 0; i < stage.places.size(); ++i)
        outcomes.push_back(from_scratch(device, stage, stage.places.back()));
    return median(device, std::move(outcomes));
}

/// The light of the place before the last, and no time at all.
MoveOutcome nothing_done(const gpu::Device& device, const Stage& stage)
{
    MoveOutcome outcome = from_scratch(device, stage, stage.places.end()[-2]);
    outcome.update = {};
    return outcome;
}

/// The lumels of `laid_out`, with the box in its last place.
MoveOutcome gathered(const gpu::Device& device, const LiveScene& laid_out, const Stage& stage)
{
    Scene scene = stage.scene;
    scene.instances[stage.box].transform = stage.places.back();
    const SolverOptions options{.method = stage.gather};
    const World world(device, scene, laid_out.lumels(), &laid_out.atlas());
    const auto solver = make_solver({&device, &world, laid_out.lumels(), {}}, options);
    MoveOutcome outcome;
    Stopwatch watch;
    watch.start();
    solve(*solver, options);
    outcome.alone = outcome.irradiance = solver->irradiance();
    watch.stop();
    outcome.update.alone_ms = outcome.update.whole_ms = 1e3 * watch.wall;
    outcome.update.alone_cpu_ms = outcome.update.whole_cpu_ms = 1e3 * watch.cpu;
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
        const Image alone = in_a_row(lumels, outcome->alone);
        outcome->from_scratch = compare_maps(row, scratch).relative_rmse;
        outcome->alone_from_scratch = compare_maps(alone, scratch).relative_rmse;
        if (truth) {
            outcome->from_truth = compare_maps(row, *truth);
            outcome->alone_from_truth = compare_maps(alone, *truth);
        }
        outcome->change_left = outcome->from_scratch / results.by[kNothing]->from_scratch;
    }
}

Results measure(const gpu::Device& device, const ThesisScene& which,
                const DynamicSettings& settings, int pieces)
{
    const Stage stage = set(which, settings, pieces);
    Results results{.title = which.title};
    results.by[kIncremental] = corrected(device, stage, Redistribution::incremental);
    results.by[kCross] = corrected(device, stage, Redistribution::cross);
    results.by[kProgressive] = from_scratch(device, stage);
    results.by[kNothing] = nothing_done(device, stage);
    count(stage, LiveScene(device, stage.scene, stage.options).lumels(), results);
    return results;
}

double sum_of(const gpu::StageTimes& stages)
{
    double sum = 0.0;
    for (const auto& [stage, ms] : stages)
        sum += ms;
    return sum;
}

/// One row for each technique from `first` on, one column for each scene.
template <class Number>
void add_table(Report& report, const std::string& key, const std::string& title,
               const std::vector<Results>& all, const Number& number, int first = kGather)
{
    std::vector<std::string> columns{"technique"};
    for (const Results& results : all)
        columns.push_back(results.title);
    report.table(key, title, columns);
    for (int technique = first; technique < kTechniques; ++technique) {
        if (!all.front().by[technique])
            continue;
        std::vector<Cell> cells{kNames[technique]};
        for (const Results& results : all)
            cells.push_back(number(*results.by[technique]));
        report.row(cells);
    }
}

void add_scenes(Report& report, const std::string& suffix, const std::vector<Results>& all)
{
    report.table("scenes" + suffix, "Scenes",
                 {"scene", "lumels that stay", "on the box", "patches", "of them on the box, |M|",
                  "vertices", "triangles"});
    for (const Results& results : all)
        report.row({results.title, results.still, results.moving, results.patches,
                    results.moving_patches, results.vertices, results.triangles});
}

void add_errors(Report& report, const std::vector<Results>& all)
{
    const auto normalized = [](const std::optional<MapError>& error) {
        return error ? fixed(error->normalized_rmse, 5) : none();
    };
    add_table(report, "normalized", "Normalized RMSE from the truth at rest ([Hoef13] table 5.1)",
              all, [&](const MoveOutcome& o) { return normalized(o.from_truth); });
    add_table(report, "normalized-alone",
              "Normalized RMSE from the truth after redistribution alone", all,
              [&](const MoveOutcome& o) { return normalized(o.alone_from_truth); });
    add_table(report, "relative", "Relative RMSE from the truth at rest, %", all,
              [&](const MoveOutcome& o) {
                  return o.from_truth ? fixed(100.0 * o.from_truth->relative_rmse, 3) : none();
              });
    add_table(
        report, "from-scratch",
        "Relative RMSE from a progressive solution from scratch, at rest, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.from_scratch, 3); }, kNothing);
    add_table(
        report, "from-scratch-alone", "The same after redistribution alone, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.alone_from_scratch, 3); }, kNothing);
    add_table(
        report, "change-left", "What is left of the change by the move, at rest, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.change_left, 1); }, kNothing);
}

void add_times(Report& report, const std::string& suffix, const std::vector<Results>& all)
{
    add_table(report, "rest-ms" + suffix, "Time of an update until at rest, wall, ms", all,
              [](const MoveOutcome& o) { return fixed(o.update.whole_ms, 0); });
    add_table(report, "alone-ms" + suffix, "Time of redistribution alone, wall, ms", all,
              [](const MoveOutcome& o) { return fixed(o.update.alone_ms, 0); });
    add_table(report, "rest-cpu-ms" + suffix, "The same until at rest, processor time, ms", all,
              [](const MoveOutcome& o) { return fixed(o.update.whole_cpu_ms, 0); });
    add_table(report, "alone-cpu-ms" + suffix,
              "The same of redistribution alone, processor time, ms", all,
              [](const MoveOutcome& o) { return fixed(o.update.alone_cpu_ms, 0); });
    add_table(report, "rest-device-ms" + suffix, "Device time until at rest, ms", all,
              [](const MoveOutcome& o) { return fixed(sum_of(o.update.stages), 0); });
    add_table(report, "alone-device-ms" + suffix, "Device time of redistribution alone, ms", all,
              [](const MoveOutcome& o) { return fixed(sum_of(o.update.alone_stages), 0); });
    add_table(report, "rest-hemicubes" + suffix, "Hemicubes until at rest", all,
              [](const MoveOutcome& o) -> Cell { return o.update.whole_hemicubes; });
    add_table(report, "alone-hemicubes" + suffix, "Hemicubes of redistribution alone", all,
              [](const MoveOutcome& o) -> Cell { return o.update.alone_hemicubes; });
}

std::string words_of(double Update::*ms)
{
    const bool by_processor = ms == &Update::whole_cpu_ms || ms == &Update::alone_cpu_ms;
    return by_processor ? "processor time" : "wall time";
}

/// How many times as fast one technique is as another.
struct Ratio {
    const char* name;
    Technique slow, fast;
};
constexpr Ratio kRatios[] = {{"gather / cross", kGather, kCross},
                             {"progressive / cross", kProgressive, kCross},
                             {"incremental / cross", kIncremental, kCross},
                             {"progressive / incremental", kProgressive, kIncremental}};

/// The techniques' times over one another.
void add_ratios(Report& report, const std::string& key, const std::string& title,
                const std::vector<Results>& all, double Update::*ms)
{
    std::vector<std::string> columns{"ratio"};
    for (const Results& results : all)
        columns.push_back(results.title);
    report.table(key, title + ", " + words_of(ms), columns);
    for (const Ratio& ratio : kRatios) {
        std::vector<Cell> cells{ratio.name};
        for (const Results& results : all) {
            const auto& slow = results.by[ratio.slow];
            cells.push_back(slow ? fixed(slow->update.*ms / (results.by[ratio.fast]->update.*ms), 2)
                                 : none());
        }
        report.row(cells);
    }
}

/// What more vertices cost [Hoef13] table 5.3.
void add_growth(Report& report, const std::string& suffix, const std::vector<Results>& few,
                const std::vector<Results>& many, double Update::*ms)
{
    std::vector<std::string> columns{"technique"};
    for (const Results& results : many)
        columns.push_back(results.title);
    report.table("growth" + suffix,
                 "Time until at rest with more vertices / with few, " + words_of(ms), columns);
    for (int technique = kProgressive; technique < kTechniques; ++technique) {
        std::vector<Cell> cells{kNames[technique]};
        for (std::size_t i = 0; i < many.size(); ++i)
            cells.push_back(
                fixed(many[i].by[technique]->update.*ms / (few[i].by[technique]->update.*ms), 2));
        report.row(cells);
    }
}

/// What one scene's techniques spend on each part.
void add_parts(Report& report, const std::string& key, const Results& results, const char* title,
               const gpu::StageTimes Update::*stages)
{
    report.table(key, fmt::format("{}: device time by part, {}", results.title, title),
                 {"technique", "part", "ms"});
    for (int technique = kGather; technique < kTechniques; ++technique) {
        if (!results.by[technique])
            continue;
        for (const auto& [stage, ms] : results.by[technique]->update.*stages)
            if (ms >= kMinShown)
                report.row({kNames[technique], stage, fixed(ms, 1)});
    }
}

/// Of the keys of tables: "" for whole edges, then as table 5.3 has its halves.
std::string suffix_of(const std::vector<int>& all_pieces, int pieces)
{
    const auto place = std::find(all_pieces.begin(), all_pieces.end(), pieces) - all_pieces.begin();
    constexpr std::array suffixes{"", "-first", "-second"};
    return place < std::ptrdiff_t(suffixes.size()) ? suffixes[std::size_t(place)]
                                                   : fmt::format("-{}", pieces);
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

void follow_moves(const DynamicSettings& settings, Report& report)
{
    const gpu::Device device(settings.shared.device);
    const ViewOptions views = options_of<ProgressiveOptions>(settings.shared).views;
    report.say(
        fmt::format("hemicubes of side {}, {} a batch, {} samples per lumel for the truth, {}",
                    views.hemicube, views.batch, settings.shared.reference_spp, words_of(device)));
    std::vector<int> all_pieces{1};
    std::copy_if(settings.pieces.begin(), settings.pieces.end(), std::back_inserter(all_pieces),
                 [](int pieces) { return pieces > 1; });
    const bool by_processor = counts_processor_time(device);
    const auto rest = by_processor ? &Update::whole_cpu_ms : &Update::whole_ms;
    std::vector<Results> whole;  // with edges in one piece
    for (const int pieces : all_pieces) {
        const std::string suffix = suffix_of(all_pieces, pieces);
        std::vector<Results> all;
        for (const ThesisScene& scene : scenes_of(settings)) {
            all.push_back(measure(device, scene, settings, pieces));
            if (pieces == 1)
                compare(device, set(scene, settings, pieces), settings, all.back());
        }
        if (pieces > 1)
            report.say(fmt::format("Edges cut into {} pieces", pieces));
        add_scenes(report, suffix, all);
        if (pieces == 1)
            add_errors(report, all);
        add_times(report, suffix, all);
        add_ratios(report, "rest-ratios" + suffix, "Times until at rest, over one another", all,
                   rest);
        add_ratios(report, "alone-ratios" + suffix,
                   "The same of redistribution alone; gather and progressive until at rest", all,
                   by_processor ? &Update::alone_cpu_ms : &Update::alone_ms);
        if (pieces > 1)
            add_growth(report, suffix, whole, all, rest);
        for (const Results& results : all) {
            const std::string key = "-" + results.title + suffix;
            add_parts(report, "alone-parts" + key, results, "redistribution alone",
                      &Update::alone_stages);
            add_parts(report, "rest-parts" + key, results, "until at rest", &Update::stages);
        }
        if (pieces == 1)
            whole = std::move(all);
    }
    device.check_validation();
}

}  // namespace lumel::bench
