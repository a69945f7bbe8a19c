#include "jobs/play/play_report.h"

#include "jobs/bake/report_parts.h"
#include "results/record/bake_record.h"
#include "results/record/solver_settings.h"

namespace lumel {
namespace {

/// As on the command line.
const char* redistribution_name(Redistribution redistribution)
{
    switch (redistribution) {
    case Redistribution::incremental:
        return "incremental";
    case Redistribution::cross:
        return "cross";
    case Redistribution::paper_incremental:
        return "paper-incremental";
    case Redistribution::paper_cross:
        return "paper-cross";
    case Redistribution::paper_cross_incremental:
        return "paper-cross-incremental";
    }
    return "";
}

}  // namespace

Report play_report(const PlayOptions& options, const PlayedLight& light, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages)
{
    Report report = report_on(light.scene(), {});
    add_usage(report, light.scene(), stages);
    add_sizes(report, light.scene(), light.atlas(), light.lumels());
    add_device(report, device);
    report.settings = {{"animation", options.animation},
                       {"frames", options.frames},
                       {"fps", options.fps},
                       {"budget", options.budget_ms},
                       {"residual", options.residual}};
    report.solver = std::visit(
        [](const auto& method) { return solver_settings({.method = method}); }, options.solver);
    if (std::holds_alternative<DirectionsOptions>(options.solver))
        report.settings["leak"] = options.leak;
    else if (std::holds_alternative<LinksOptions>(options.solver)) {
        report.settings["links"] = options.link_rays;
        report.settings["bake_error"] = options.budget_ms > 0.0 ? 0.0 : options.bake_error;
        for (const char* unread : {"sampling", "rays"})
            (*report.solver)["options"].erase(unread);
    } else
        report.settings["redistribution"] = redistribution_name(options.redistribution);
    report.settings.update(atlas_settings(options.atlas));
    report.shots = light.shots();
    report.frames = std::move(frames);
    report.interrupted = stages.stopped();
    report.exposure = options.exposure;
    report.picture_width = options.width;
    report.picture_height = height;
    add_times(report, "", light.times());
    return report;
}

}  // namespace lumel
