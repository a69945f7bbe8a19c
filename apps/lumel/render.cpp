// lumel render: a picture of the scene from one of its cameras.

#include <fmt/core.h>

#include "commands.h"
#include "core/log.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace lumel {

int run(const RenderArguments& arguments)
{
    watch_interrupts();
    set_quiet(arguments.talk.quiet || arguments.talk.json);
    ProgressBar bar(arguments.talk.progress && !arguments.talk.quiet,
                    arguments.options.bake.solver.batch);
    const RenderSummary summary = render(arguments.scene, arguments.picture, arguments.options,
                                         [&](const BakeProgress& progress) {
                                             bar.show(progress);
                                             return !interrupted();
                                         });
    bar.clear();
    if (arguments.talk.json)
        fmt::print("{}\n", summary.report);
    else if (!arguments.talk.quiet)
        fmt::print("{}: {} x {} pixels in {:.1f} s{}\n", arguments.picture, summary.width,
                   summary.height, summary.seconds, summary.interrupted ? ", stopped early" : "");
    return interrupted() ? interrupt_exit_code() : kExitDone;
}

}  // namespace lumel
