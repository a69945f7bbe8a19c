#include "bench/papers/all.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/files.h"
#include "bench/papers/commands.h"
#include "bench/papers/page.h"
#include "bench/stopwatch.h"
#include "results/files/folder.h"

namespace lumel::bench {
namespace {

constexpr const char* kPage = "papers.html";

std::vector<const Run*> chosen(const AllSettings& settings)
{
    std::vector<const Run*> runs;
    std::string keys;
    for (const Run& run : all_runs()) {
        keys += fmt::format("{}{}", keys.empty() ? "" : ", ", run.key);
        if (settings.figures.empty() ||
            std::count(settings.figures.begin(), settings.figures.end(), run.key) > 0)
            runs.push_back(&run);
    }
    for (const std::string& wanted : settings.figures)
        if (std::none_of(runs.begin(), runs.end(),
                         [&](const Run* run) { return run->key == wanted; }))
            throw Error(ErrorKind::input, "--figures " + wanted, "is none of " + keys);
    return runs;
}

std::vector<std::string> arguments_of(const std::string& command, const std::string& folder)
{
    std::vector<std::string> arguments;
    std::istringstream words(command);
    for (std::string word; words >> word;)
        arguments.push_back(word == "{out}" ? folder : word);
    return arguments;
}

void make(const Run& run, const AllSettings& settings, Outcome& outcome)
{
    Stopwatch watch;
    watch.start();
    try {
        run_figure(arguments_of(run.command(settings.extent), settings.folder), outcome.report);
    } catch (const std::exception& error) {
        outcome.failure = error.what();
    }
    watch.stop();
    outcome.wall = watch.wall;
    outcome.cpu = watch.cpu;
}

void write_page(const Outcomes& outcomes, const AllSettings& settings)
{
    OutputFolder folder(settings.folder);
    write_text(folder.path(kPage), page_of(outcomes, settings.extent, settings.folder));
    folder.commit();
}

/// The comparison as Markdown, as the page has it.
void print_summary(const Outcomes& outcomes)
{
    Report summary;
    summary.table("summary", tally_of(outcomes),
                  {"paper", "where", "what", "paper's", "ours", "met if", "verdict"}, none());
    for (const PaperValue& value : paper_values()) {
        const Judgement judgement = judge(value, outcomes);
        summary.row({value.paper, value.place, value.quantity, value.value, judgement.ours,
                     bar_of(value), words_of(judgement.verdict)},
                    judgement.our_default);
    }
    summary.table("times", "Time of each figure", {"figure", "s", "cpu s"}, "its cells");
    for (const Run& run : all_runs())
        if (const auto outcome = outcomes.find(run.key); outcome != outcomes.end())
            summary.row({run.key, fixed(outcome->second.wall, 0), fixed(outcome->second.cpu, 0)});
}

}  // namespace

bool make_all(const AllSettings& settings)
{
    const std::vector<const Run*> runs = chosen(settings);
    Outcomes outcomes;
    write_page(outcomes, settings);  // a folder of no use is found before an hour has passed
    bool complete = true;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Run& run = *runs[i];
        fmt::print(stderr, "{} of {}: {}\n", i + 1, runs.size(), run.key);
        fmt::print("\n## {}\n\n    lumel-papers {}\n", run.title, run.command(settings.extent));
        Outcome& outcome = outcomes[run.key];
        make(run, settings, outcome);
        fmt::print(stderr, "{}: {:.0f} s{}{}\n", run.key, outcome.wall,
                   outcome.failure.empty() ? "" : ", failed: ", outcome.failure);
        complete = complete && outcome.failure.empty();
        write_page(outcomes, settings);
    }
    print_summary(outcomes);
    fmt::print(stderr, "{}\n",
               (std::filesystem::path(settings.folder) / kPage).lexically_normal().string());
    return complete;
}

}  // namespace lumel::bench
