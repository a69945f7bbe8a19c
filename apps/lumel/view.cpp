// lumel view: a lit scene under the hand.

#include "viewer/session/view.h"

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"
#include "viewer/window/window.h"

namespace lumel {

int run(const ViewArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const ViewSummary summary = (arguments.headless ? play_script : show_window)(
            arguments.run, arguments.options, progress);
        return Conclusion{summary.report,
                          fmt::format("{}: {} files, {} frames in {:.1f} s", arguments.run.folder,
                                      summary.files.size(), summary.frames, summary.seconds),
                          false};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
