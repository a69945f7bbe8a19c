// lumel update: a bake follows its scene.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {
namespace {

/// "2 moved, 1 appeared", or "nothing has changed".
std::string changes_in(const UpdateRow& row)
{
    std::string list;
    const auto add = [&](std::uint64_t count, const char* what) {
        if (count > 0)
            list += fmt::format("{}{} {}", list.empty() ? "" : ", ", count, what);
    };
    add(row.moved, "moved");
    add(row.appeared, "appeared");
    add(row.vanished, "vanished");
    add(row.recoloured, "changed colour");
    if (row.relit)
        list += list.empty() ? "sky or lamps differ" : ", sky or lamps differ";
    return list.empty() ? "nothing has changed" : list;
}

std::string sentence_of(const UpdateSummary& summary)
{
    const UpdateRow& row = summary.row;
    if (!row.any())
        return changes_in(row);
    std::string error;
    if (summary.eye_error >= 0.0)
        error = ", " + eye_error_text(summary.eye_error, summary.error);
    else if (summary.error >= 0.0)
        error = fmt::format(", estimated error of the map {:.2f} %", 100.0 * summary.error);
    if (row.links > 0)
        return fmt::format("{}: traced {} of {} links in {:.1f} s{}", changes_in(row), row.rays,
                           row.links, summary.seconds, error);
    if (row.solved_anew)
        return fmt::format("{}: too much to correct: solved anew in {:.1f} s{}", changes_in(row),
                           summary.seconds, error);
    return fmt::format(
        "{}: corrected with {} rays and {} particles in {:.1f} s, residual {:.2f} %{}",
        changes_in(row), row.rays, row.particles, summary.seconds, 100.0 * row.residual, error);
}

}  // namespace

int run(const UpdateArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const UpdateSummary summary =
            update(arguments.folder, arguments.scene, arguments.options, progress);
        return Conclusion{summary.report,
                          fmt::format("{}: {}", arguments.folder, sentence_of(summary)),
                          summary.interrupted};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
