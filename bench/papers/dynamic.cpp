// [Hoef13] chapter 5: how far corrected solutions are from the truth, and what they take.

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "bench/papers/dynamic_pictures.h"
#include "bench/papers/dynamic_stage.h"
#include "bench/papers/dynamic_tables.h"
#include "bench/papers/figures.h"
#include "bench/stopwatch.h"
#include "solve/solver/solver.h"
#include "solve/transport/patches.h"
#include "truth/metrics.h"
#include "truth/reference.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kReferenceSeed = 99;
constexpr std::pair<MoveTechnique, Redistribution> kRedistributions[] = {
    {kIncremental, Redistribution::incremental},
    {kCross, Redistribution::cross},
    {kPaperIncremental, Redistribution::paper_incremental},
    {kPaperCross, Redistribution::paper_cross},
    {kPaperCrossIncremental, Redistribution::paper_cross_incremental}};

void count(const Stage& stage, const Lumels& lumels, MoveResults& results)
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
    std::vector<glm::vec3> before;
    for (const glm::mat4& place : stage.places) {
        before = live.irradiance();
        outcomes.push_back({.update = update_after_move(live, stage.box, place)});
    }
    const std::vector<glm::vec3> alone = outcomes.back().update.alone;
    MoveOutcome outcome = median(device, std::move(outcomes));
    outcome.before = std::move(before);
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

/// In the place before the last and in the last one, each solved from scratch.
BeforeAndAfter both_from_scratch(const gpu::Device& device, const Stage& stage)
{
    return {from_scratch(device, stage, stage.places.end()[-2]).irradiance,
            from_scratch(device, stage, stage.places.back()).irradiance};
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
    const Scene scene = posed(stage);
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

/// Errors of all techniques and of our default, and the light that they are taken against.
void compare(const Stage& stage, const LiveScene& laid_out, const DynamicSettings& settings,
             MoveResults& results)
{
    const Lumels& lumels = laid_out.lumels();
    std::optional<Image> truth;
    if (settings.shared.reference_spp > 0) {
        const Scene scene = posed(stage);
        results.truth = reference_irradiance(
            scene, RayScene(scene), lumels,
            {.samples_per_lumel = settings.shared.reference_spp, .seed = kReferenceSeed});
        truth = in_a_row(lumels, results.truth);
        results.ours_from_truth = compare_maps(in_a_row(lumels, results.ours.irradiance), *truth);
    }
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

/// Distances of each redistribution, and of a solution with another seed, from solutions from
/// scratch.
void share_out(const gpu::Device& device, const Stage& stage, const Lumels& lumels,
               MoveResults& results)
{
    const BeforeAndAfter progressive{results.by[kNothing]->irradiance,
                                     results.by[kProgressive]->irradiance};
    for (const auto& [technique, redistribution] : kRedistributions) {
        MoveOutcome& outcome = *results.by[technique];
        Stage own = stage;
        own.options.redistribution = redistribution;
        outcome.own =
            share_of_move(lumels, {outcome.before, outcome.irradiance},
                          crosses(redistribution) ? both_from_scratch(device, own) : progressive);
    }
    Stage other = stage;
    ++other.options.solver.seed;
    results.other_seed = share_of_move(lumels, both_from_scratch(device, other), progressive);
}

MoveResults measure(const gpu::Device& device, const ThesisScene& which,
                    const DynamicSettings& settings, int pieces)
{
    const Stage stage = set(which, settings, pieces);
    const LiveScene laid_out(device, stage.scene, stage.options);
    MoveResults results{.title = which.title};
    for (const auto& [technique, redistribution] : kRedistributions)
        results.by[technique] = corrected(device, stage, redistribution);
    results.by[kProgressive] = from_scratch(device, stage);
    results.by[kNothing] = nothing_done(device, stage);
    results.ours =
        solve_by_default(device, SolveScene(posed(stage), laid_out.atlas(), laid_out.lumels()));
    count(stage, laid_out.lumels(), results);
    if (pieces > 1)
        return results;
    if (settings.gathers)
        results.by[kGather] = gathered(device, laid_out, stage);
    compare(stage, laid_out, settings, results);
    share_out(device, stage, laid_out.lumels(), results);
    if (!settings.folder.empty())
        results.picture = draw_techniques(device, posed(stage), laid_out.atlas(), laid_out.lumels(),
                                          which, settings, results);
    return results;
}

/// Of the keys of tables: "" for whole edges, then as table 5.3 has its halves.
std::string suffix_of(const std::vector<int>& all_pieces, int pieces)
{
    const auto place = std::find(all_pieces.begin(), all_pieces.end(), pieces) - all_pieces.begin();
    constexpr std::array suffixes{"", "-first", "-second"};
    return place < std::ptrdiff_t(suffixes.size()) ? suffixes[std::size_t(place)]
                                                   : fmt::format("-{}", pieces);
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
    std::vector<MoveResults> whole;  // with edges in one piece
    for (const int pieces : all_pieces) {
        const std::string suffix = suffix_of(all_pieces, pieces);
        std::vector<MoveResults> all;
        for (const ThesisScene& scene : scenes_of(settings))
            all.push_back(measure(device, scene, settings, pieces));
        if (pieces > 1)
            report.say(fmt::format("Edges cut into {} pieces", pieces));
        add_scenes(report, suffix, all);
        if (pieces == 1)
            add_errors(report, all);
        add_times(report, suffix, all, by_processor);
        if (pieces == 1)
            add_overview(report, all, by_processor);
        if (pieces > 1)
            add_growth(report, suffix, whole, all, by_processor);
        for (const MoveResults& results : all)
            if (results.picture)
                report.picture(results.picture->path, results.picture->caption);
        if (pieces == 1)
            whole = std::move(all);
    }
    if (!settings.folder.empty())
        draw_artefacts(device, settings, report);
    device.check_validation();
}

}  // namespace lumel::bench
