// lumel reference: the same map by path tracing on the CPU.

#include <cstdio>

#include <fmt/core.h>

#include "commands.h"
#include "core/log.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace lumel {

int run(const ReferenceArguments& arguments)
{
    watch_interrupts();
    set_quiet(arguments.talk.quiet || arguments.talk.json);
    ProgressBar bar(arguments.talk.progress && !arguments.talk.quiet, 0);
    const BakeSummary summary =
        bake_reference(arguments.scene, arguments.folder, arguments.options, arguments.reference,
                       arguments.materials, [&](const BakeProgress& progress) {
                           bar.show(progress);
                           return !interrupted();
                       });
    bar.clear();
    if (arguments.talk.json)
        fmt::print("{}\n", summary.report);
    else if (!arguments.talk.quiet)
        fmt::print("{}: {} paths per lumel in {:.1f} s{}\n", arguments.folder,
                   arguments.reference.samples_per_lumel, summary.seconds,
                   summary.interrupted ? ", stopped early" : "");
    return interrupted() ? interrupt_exit_code() : kExitDone;
}

}  // namespace lumel
