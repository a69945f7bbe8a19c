#include "jobs/render/picture_report.h"

#include "jobs/bake/report_parts.h"
#include "methods/methods.h"
#include "results/record/bake_record.h"
#include "results/record/solver_settings.h"

namespace lumel {
namespace {

/// Adds the properties of the image.
void add_picture(Report& report, const RenderOptions& options)
{
    report.picture_width = options.width;
    report.picture_height = options.height;
    if (options.camera >= 0)
        report.settings["camera"] = options.camera;
}

}  // namespace

Report picture_report(const RenderOptions& options, const SolveScene& prepared,
                      const gpu::Device& device, const Solver& solver, const Results& results,
                      const Stages& stages)
{
    Report report = report_on(prepared.scene, options.bake.lights);
    add_facts(report, prepared, stages);
    add_solution(report, device, solver, results);
    report.settings = atlas_settings(options.bake.atlas);
    report.settings["sky-directions"] = options.bake.sky_directions;
    add_picture(report, options);
    report.settings["places"] = options.sets;
    if (options.layers)
        report.settings["layers"] = true;
    else
        report.settings["eye-shots"] = options.shots;
    report.settings["lobe-rays"] = options.rays;
    report.solver = solver_settings(options.bake.solver);
    return report;
}

Report path_traced_report(const RenderOptions& options, const Scene& scene, const Stages& stages)
{
    Report report = report_on(scene, options.bake.lights);
    add_usage(report, scene, stages);
    add_picture(report, options);
    report.settings["paths"] = options.paths;
    report.solver = path_tracer_settings(seed_of(options.bake.solver.method));
    report.interrupted = stages.stopped();
    return report;
}

}  // namespace lumel
