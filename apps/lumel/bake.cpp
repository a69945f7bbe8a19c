// lumel bake: the scene in, solved lightmaps and a lit glTF out.

#include <array>

#include <fmt/core.h>

#include "commands.h"
#include "jobs/bake/bake.h"
#include "jobs/solve/stages.h"
#include "long_work.h"
#include "methods/methods.h"
#include "results/page/page.h"

namespace lumel {

int run(const BakeArguments& arguments, Ranks* ranks)
{
    if (arguments.page)
        check_viewer();
    const auto work = [&](const ProgressFunction& progress) {
        const BakeSummary summary =
            bake(arguments.scene, arguments.folder, arguments.options, progress, ranks);
        if (arguments.page)
            write_page(page_in(arguments.folder), std::array{arguments.folder});
        std::string error;
        if (summary.eye_error >= 0.0)
            error = ", " + eye_error_text(summary.eye_error, summary.error);
        else if (summary.error >= 0.0)
            error = fmt::format(", estimated error {:.2f} %", 100.0 * summary.error);
        if (summary.visible_noise.worst_chart >= 0.0)
            error +=
                fmt::format(", visible noise {:.2f} %", 100.0 * summary.visible_noise.worst_chart);
        const SolverOptions& solver = arguments.options.solver;
        // A matrix shoots for lamps without a form factor alone.
        const std::string rays = summary.shots > 0 ? fmt::format("{} {} in ", summary.shots,
                                                                 method_of(solver.method).shots)
                                                   : "";
        if (solver.has_default_limits() &&
            (summary.eye_error > kGood.eye_error ||
             summary.visible_noise.worst_chart > kGood.visible_noise))
            error += "; --quality good goes on";
        return Conclusion{summary.report,
                          fmt::format("{0}: {1}{2:.1f} s{3}\n"
                                      "{0}/scene-baked.glb is for any glTF viewer; "
                                      "{0}/scene.glb, with the lightmap, for three.js and engines",
                                      arguments.folder, rays, summary.seconds, error),
                          summary.interrupted};
    };
    return do_long_work(arguments.talk, batch_of(arguments.options.solver.method), work);
}

}  // namespace lumel
