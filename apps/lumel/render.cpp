// lumel render: a picture of the scene from one of its cameras.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {

int run(const RenderArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const RenderSummary summary =
            render(arguments.scene, arguments.picture, arguments.options, progress);
        const bool film = arguments.options.film.frames > 0;
        const std::string what =
            film ? fmt::format("{} to {}", summary.files.front(), summary.files.back())
                 : arguments.picture;
        const std::string more = arguments.options.layers ? fmt::format(", and {} files beside it",
                                                                        summary.files.size() - 1)
                                                          : "";
        return Conclusion{summary.report,
                          fmt::format("{}: {} x {} pixels{} in {:.1f} s{}", what, summary.width,
                                      summary.height, film ? ", the last" : "", summary.seconds,
                                      more),
                          summary.interrupted};
    };
    return do_long_work(arguments.talk, batch_of(arguments.options.bake.solver.method), work);
}

}  // namespace lumel
