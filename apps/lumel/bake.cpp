// lumel bake: the scene in, solved lightmaps and a lit glTF out.

#include <cstdio>

#include <fmt/core.h>

#include "commands.h"
#include "core/log.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace lumel {
namespace {

void print_summary(const BakeSummary& summary, const std::string& folder, const Talk& talk)
{
    if (talk.json) {
        fmt::print("{}\n", summary.report);
    } else if (!talk.quiet) {
        const std::string error =
            summary.error < 0.0 ? ""
                                : fmt::format(", estimated error {:.2f} %", 100.0 * summary.error);
        fmt::print("{}: {} shots in {:.1f} s{}{}\n", folder, summary.shots, summary.seconds, error,
                   summary.interrupted ? ", stopped early" : "");
    }
}

}  // namespace

int run(const BakeArguments& arguments)
{
    watch_interrupts();
    set_quiet(arguments.talk.quiet || arguments.talk.json);
    ProgressBar bar(arguments.talk.progress && !arguments.talk.quiet,
                    arguments.options.solver.batch);
    const BakeSummary summary = bake(arguments.scene, arguments.folder, arguments.options,
                                     [&](const BakeProgress& progress) {
                                         bar.show(progress);
                                         return !interrupted();
                                     });
    bar.clear();
    print_summary(summary, arguments.folder, arguments.talk);
    return interrupted() ? interrupt_exit_code() : kExitDone;
}

}  // namespace lumel
