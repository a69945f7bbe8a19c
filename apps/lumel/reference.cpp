// lumel reference: the same map by path tracing on the CPU.

#include <fmt/core.h>

#include "commands.h"
#include "long_work.h"

namespace lumel {

int run(const ReferenceArguments& arguments)
{
    const auto work = [&](const ProgressFunction& progress) {
        const BakeSummary summary =
            bake_reference(arguments.scene, arguments.folder, arguments.options,
                           arguments.reference, arguments.materials, progress);
        return Conclusion{summary.report,
                          fmt::format("{}: {} paths per lumel in {:.1f} s", arguments.folder,
                                      arguments.reference.samples_per_lumel, summary.seconds),
                          summary.interrupted};
    };
    return do_long_work(arguments.talk, 0, work);
}

}  // namespace lumel
