// lumel bake: the scene in, solved lightmaps and a lit glTF out.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {

int run(const BakeArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const BakeSummary summary =
            bake(arguments.scene, arguments.folder, arguments.options, progress);
        const std::string error =
            summary.error < 0.0 ? ""
                                : fmt::format(", estimated error {:.2f} %", 100.0 * summary.error);
        return Conclusion{summary.report,
                          fmt::format("{}: {} shots in {:.1f} s{}", arguments.folder, summary.shots,
                                      summary.seconds, error),
                          summary.interrupted};
    };
    return do_long_work(arguments.talk, batch_of(arguments.options.solver.method), work);
}

}  // namespace lumel
