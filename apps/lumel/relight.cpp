// lumel relight: a bake under other states of its lights.

#include <algorithm>

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {
namespace {

/// A line for each state, then what it took in all.
std::string table_of(const std::string& folder, const RelightSummary& summary)
{
    std::size_t width = 5;
    for (const StateRow& row : summary.states)
        width = std::max(width, row.name.size());
    const bool stated = std::any_of(summary.states.begin(), summary.states.end(),
                                    [](const StateRow& row) { return row.error >= 0.0; });
    std::string table = fmt::format("{:<{}}  light [s]  files [s]{}\n", "state", width,
                                    stated ? "  estimated error [%]" : "");
    for (const StateRow& row : summary.states) {
        table += fmt::format("{:<{}}  {:>9.4f}  {:>9.4f}", row.name, width, row.light, row.files);
        const double stated_error = row.eye_error >= 0.0 ? row.eye_error : row.error;
        const std::string error =
            stated_error >= 0.0 ? fmt::format("{:.2f}", 100.0 * stated_error) : "–";
        table += stated ? fmt::format("  {:>19}\n", error) : "\n";
    }
    return table + fmt::format("{}/states: {} states in {:.1f} s", folder, summary.states.size(),
                               summary.seconds);
}

}  // namespace

int run(const RelightArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const RelightSummary summary =
            relight(arguments.folder, arguments.states, arguments.options, progress);
        return Conclusion{summary.report, table_of(arguments.folder, summary), summary.interrupted};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
