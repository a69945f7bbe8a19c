// lumel probes: the light in the air of a bake, as spherical harmonics.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {
namespace {

std::string printed(const ProbesSummary& summary)
{
    std::string text = fmt::format("{}: {} {}", summary.file, summary.rows.size(),
                                   summary.rows.size() == 1 ? "probe" : "probes");
    if (const auto& grid = summary.grid)
        text += fmt::format(", of a grid of {} x {} x {}", grid->counts.x, grid->counts.y,
                            grid->counts.z);
    if (summary.inside > 0)
        text += fmt::format(", {} inside of things", summary.inside);
    return text;
}

}  // namespace

int run(const ProbesArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const ProbesSummary summary = probes(arguments.folder, arguments.options, progress);
        return Conclusion{summary.report, printed(summary), false};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
