#include "bench/papers/dynamic_tables.h"

#include <algorithm>

#include <fmt/format.h>

namespace lumel::bench {
namespace {

constexpr double kMinShown = 0.1;  ///< of a part's time [ms]

double sum_of(const gpu::StageTimes& stages)
{
    double sum = 0.0;
    for (const auto& [stage, ms] : stages)
        sum += ms;
    return sum;
}

/// One row for each scene, one column for each technique from `first` on, then our default.
template <class Number, class Ours>
void add_table(Report& report, const std::string& key, const std::string& title,
               const std::vector<MoveResults>& all, const Number& number, const Ours& ours,
               int first = kGather)
{
    std::vector<std::string> columns{"scene"};
    for (int technique = first; technique < kTechniques; ++technique)
        if (all.front().by[technique])
            columns.push_back(kTechniqueNames[technique]);
    report.table(key, title, columns, kSolvedAnew);
    for (const MoveResults& results : all) {
        std::vector<Cell> cells{results.title};
        for (int technique = first; technique < kTechniques; ++technique)
            if (results.by[technique])
                cells.push_back(number(*results.by[technique]));
        report.row(cells, ours(results));
    }
}

/// The same of what our default does not have, and why.
template <class Number>
void add_table(Report& report, const std::string& key, const std::string& title,
               const std::vector<MoveResults>& all, const Number& number, const char* why,
               int first = kGather)
{
    add_table(
        report, key, title, all, number, [&](const MoveResults&) { return Cell(why); }, first);
}

/// How many times as fast one technique is as another.
struct Ratio {
    const char* name;
    MoveTechnique slow, fast;
};
constexpr Ratio kRatios[] = {
    {"gather / cross", kGather, kCross},
    {"progressive / cross", kProgressive, kCross},
    {"incremental / cross", kIncremental, kCross},
    {"progressive / incremental", kProgressive, kIncremental},
    {"progressive / paper-cross", kProgressive, kPaperCross},
    {"progressive / paper-cross-incremental", kProgressive, kPaperCrossIncremental},
    {"progressive / paper-incremental", kProgressive, kPaperIncremental}};

const char* words_of_time(bool by_processor)
{
    return by_processor ? ", processor time" : ", wall time";
}

double ms_of(const Solved& solved, bool by_processor)
{
    return 1e3 * (by_processor ? solved.cpu : solved.wall);
}

/// The techniques' times over one another, and progressive over our default.
void add_ratios(Report& report, const std::string& key, const std::string& title,
                const std::vector<MoveResults>& all, double Update::*ms, bool by_processor)
{
    std::vector<std::string> columns{"scene"};
    for (const Ratio& ratio : kRatios)
        columns.push_back(ratio.name);
    report.table(key, title + words_of_time(by_processor), columns, kSolvedAnew);
    for (const MoveResults& results : all) {
        std::vector<Cell> cells{results.title};
        for (const Ratio& ratio : kRatios) {
            const auto &slow = results.by[ratio.slow], &fast = results.by[ratio.fast];
            cells.push_back(slow && fast ? fixed(slow->update.*ms / (fast->update.*ms), 2)
                                         : none());
        }
        const double ratio =
            results.by[kProgressive]->update.*ms / ms_of(results.ours, by_processor);
        report.row(cells, {fmt::format("progressive / ours {:.2f}", ratio), ratio});
    }
}

/// What one scene's techniques spend on each part.
void add_parts(Report& report, const std::string& key, const MoveResults& results,
               const char* title, const gpu::StageTimes Update::*stages)
{
    report.table(key, fmt::format("{}: device time by part, {}", results.title, title),
                 {"technique", "part", "ms"}, "other parts");
    for (int technique = kGather; technique < kTechniques; ++technique) {
        if (!results.by[technique])
            continue;
        for (const auto& [stage, ms] : results.by[technique]->update.*stages)
            if (ms >= kMinShown)
                report.row({kTechniqueNames[technique], stage, fixed(ms, 1)});
    }
}

void add_errors_from_truth(Report& report, const std::vector<MoveResults>& all)
{
    const auto normalized = [](const std::optional<MapError>& error) {
        return fixed(error->normalized_rmse, 5);
    };
    const auto relative = [](const std::optional<MapError>& error) {
        return fixed(100.0 * error->relative_rmse, 3);
    };
    const auto normalized_ours = [&](const MoveResults& r) {
        return normalized(r.ours_from_truth);
    };
    const auto relative_ours = [&](const MoveResults& r) {
        return words_of(r.ours_from_truth->relative_rmse, r.ours.cpu);
    };
    add_table(
        report, "normalized", "Normalized RMSE from the truth at rest ([Hoef13] table 5.1)", all,
        [&](const MoveOutcome& o) { return normalized(o.from_truth); }, normalized_ours, kNothing);
    add_table(
        report, "normalized-alone", "Normalized RMSE from the truth after redistribution alone",
        all, [&](const MoveOutcome& o) { return normalized(o.alone_from_truth); }, normalized_ours,
        kNothing);
    add_table(
        report, "relative", "Relative RMSE from the truth at rest, %", all,
        [&](const MoveOutcome& o) { return relative(o.from_truth); }, relative_ours, kNothing);
}

/// What a move leaves of its change, and what another seed does.
void add_shares(Report& report, const std::vector<MoveResults>& all)
{
    const auto add = [&](const char* key, const char* title, double ShareOfMove::*share) {
        add_table(
            report, key, title, all,
            [&](const MoveOutcome& o) {
                return o.own ? fixed(100.0 * ((*o.own).*share), 1) : none();
            },
            kSolvedAnew, kProgressive);
    };
    add("own-left",
        "What is left of the change by the move, from a solution from scratch by the same "
        "technique, at rest, %",
        &ShareOfMove::left);
    add("own-missed", "The same of the changes, without a standing offset, %",
        &ShareOfMove::missed);
    report.table("other-seed",
                 "Two progressive solutions whose lumels receive at other points, over the change "
                 "by the move, %",
                 {"scene", "left", "missed"}, kSolvedAnew);
    for (const MoveResults& results : all)
        report.row({results.title, fixed(100.0 * results.other_seed.left, 1),
                    fixed(100.0 * results.other_seed.missed, 1)});
}

}  // namespace

void add_scenes(Report& report, const std::string& suffix, const std::vector<MoveResults>& all)
{
    report.table("scenes" + suffix, "Scenes",
                 {"scene", "lumels that stay", "on the box", "patches", "of them on the box, |M|",
                  "vertices", "triangles"},
                 "same lumels");
    for (const MoveResults& results : all)
        report.row({results.title, results.still, results.moving, results.patches,
                    results.moving_patches, results.vertices, results.triangles});
}

void add_errors(Report& report, const std::vector<MoveResults>& all)
{
    if (!all.front().truth.empty())
        add_errors_from_truth(report, all);
    add_table(
        report, "from-scratch",
        "Relative RMSE from a progressive solution from scratch, at rest, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.from_scratch, 3); }, kSolvedAnew,
        kNothing);
    add_table(
        report, "from-scratch-alone", "The same after redistribution alone, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.alone_from_scratch, 3); }, kSolvedAnew,
        kNothing);
    add_table(
        report, "change-left", "What is left of the change by the move, at rest, %", all,
        [](const MoveOutcome& o) { return fixed(100.0 * o.change_left, 1); }, kSolvedAnew,
        kNothing);
    add_shares(report, all);
}

void add_times(Report& report, const std::string& suffix, const std::vector<MoveResults>& all,
               bool by_processor)
{
    const auto wall = [](const MoveResults& r) { return fixed(ms_of(r.ours, false), 0); };
    const auto cpu = [](const MoveResults& r) { return fixed(ms_of(r.ours, true), 0); };
    add_table(
        report, "rest-ms" + suffix, "Time of an update until at rest, wall, ms", all,
        [](const MoveOutcome& o) { return fixed(o.update.whole_ms, 0); }, wall);
    add_table(
        report, "alone-ms" + suffix, "Time of redistribution alone, wall, ms", all,
        [](const MoveOutcome& o) { return fixed(o.update.alone_ms, 0); }, wall);
    add_table(
        report, "rest-cpu-ms" + suffix, "The same until at rest, processor time, ms", all,
        [](const MoveOutcome& o) { return fixed(o.update.whole_cpu_ms, 0); }, cpu);
    add_table(
        report, "alone-cpu-ms" + suffix, "The same of redistribution alone, processor time, ms",
        all, [](const MoveOutcome& o) { return fixed(o.update.alone_cpu_ms, 0); }, cpu);
    constexpr const char* kNoDevice = "no device";
    add_table(
        report, "rest-device-ms" + suffix, "Device time until at rest, ms", all,
        [](const MoveOutcome& o) { return fixed(sum_of(o.update.stages), 0); }, kNoDevice);
    add_table(
        report, "alone-device-ms" + suffix, "Device time of redistribution alone, ms", all,
        [](const MoveOutcome& o) { return fixed(sum_of(o.update.alone_stages), 0); }, kNoDevice);
    add_table(
        report, "rest-hemicubes" + suffix, "Hemicubes until at rest", all,
        [](const MoveOutcome& o) -> Cell { return o.update.whole_hemicubes; }, kTracesRays);
    add_table(
        report, "alone-hemicubes" + suffix, "Hemicubes of redistribution alone", all,
        [](const MoveOutcome& o) -> Cell { return o.update.alone_hemicubes; }, kTracesRays);
    add_ratios(report, "rest-ratios" + suffix, "Times until at rest, over one another", all,
               by_processor ? &Update::whole_cpu_ms : &Update::whole_ms, by_processor);
    add_ratios(report, "alone-ratios" + suffix,
               "The same of redistribution alone; gather and progressive until at rest", all,
               by_processor ? &Update::alone_cpu_ms : &Update::alone_ms, by_processor);
    for (const MoveResults& results : all) {
        const std::string key = "-" + results.title + suffix;
        add_parts(report, "alone-parts" + key, results, "redistribution alone",
                  &Update::alone_stages);
        add_parts(report, "rest-parts" + key, results, "until at rest", &Update::stages);
    }
}

void add_overview(Report& report, const std::vector<MoveResults>& all, bool by_processor)
{
    const auto named = [&](const char* title) {
        return std::find_if(all.begin(), all.end(),
                            [&](const MoveResults& results) { return results.title == title; });
    };
    const auto high = named("Cornell, large"), low = named("Low quality");
    if (high == all.end() || low == all.end())
        return;
    const auto ms = by_processor ? &Update::whole_cpu_ms : &Update::whole_ms;
    const double ours = 0.5 * (ms_of(high->ours, by_processor) + ms_of(low->ours, by_processor));
    report.table("overview",
                 std::string("Time until at rest, mean of the large lamp at high and at low "
                             "quality, ms ([Hoef13] table 5.4)") +
                     words_of_time(by_processor),
                 {"technique", "ms"}, {fmt::format("{:.0f} ms", ours), ours});
    for (int technique = kProgressive; technique < kTechniques; ++technique)
        report.row(
            {kTechniqueNames[technique],
             fixed(0.5 * (high->by[technique]->update.*ms + low->by[technique]->update.*ms), 0)});
}

void add_growth(Report& report, const std::string& suffix, const std::vector<MoveResults>& few,
                const std::vector<MoveResults>& many, bool by_processor)
{
    const auto ms = by_processor ? &Update::whole_cpu_ms : &Update::whole_ms;
    std::vector<std::string> columns{"scene"};
    for (int technique = kProgressive; technique < kTechniques; ++technique)
        columns.push_back(kTechniqueNames[technique]);
    report.table("growth" + suffix,
                 std::string("Time until at rest with more vertices / with few ([Hoef13] table "
                             "5.3)") +
                     words_of_time(by_processor),
                 columns, kSolvedAnew);
    for (std::size_t i = 0; i < many.size(); ++i) {
        std::vector<Cell> cells{many[i].title};
        for (int technique = kProgressive; technique < kTechniques; ++technique)
            cells.push_back(
                fixed(many[i].by[technique]->update.*ms / (few[i].by[technique]->update.*ms), 2));
        report.row(cells,
                   fixed(ms_of(many[i].ours, by_processor) / ms_of(few[i].ours, by_processor), 2));
    }
}

}  // namespace lumel::bench
