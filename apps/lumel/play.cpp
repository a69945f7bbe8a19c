// lumel play: pictures of a scene that moves.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {

int run(const PlayArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const PlaySummary summary =
            play(arguments.scene, arguments.folder, arguments.options, progress);
        return Conclusion{summary.report,
                          fmt::format("{}: {} frames in {:.1f} s", arguments.folder, summary.frames,
                                      summary.seconds),
                          summary.interrupted};
    };
    const int batch =
        std::visit([](const auto& method) { return batch_of(method); }, arguments.options.solver);
    return do_long_work(arguments.talk, batch, work);
}

}  // namespace lumel
