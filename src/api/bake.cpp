// The pipeline of `lumel bake`, without files.

#include "api/bake.h"

#include <cmath>

#include "api/device.h"
#include "api/fields.h"
#include "api/scene.h"
#include "api/translate.h"
#include "api/values.h"
#include "atlas/finish/finish.h"
#include "base/core/log.h"
#include "jobs/bake/advice.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/memory_plan.h"
#include "jobs/solve/sources.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"

namespace lumel::v0 {
namespace {

[[noreturn]] void refuse_setting(const std::string& setting, const std::string& what)
{
    throw lumel::Error(lumel::ErrorKind::input, "BakeSettings::" + setting, what);
}

lumel::Parts parts_of(Parts parts)
{
    switch (parts) {
    case Parts::direct:
        return lumel::Parts::direct;
    case Parts::indirect:
        return lumel::Parts::indirect;
    default:
        return lumel::Parts::all;
    }
}

MethodOptions method_of(const BakeSettings& settings)
{
    std::map<std::string, std::string> given = settings.options;
    if (!given.emplace("seed", std::to_string(settings.seed)).second)
        refuse_setting("options", "the seed is a setting of its own");
    return method_options(settings.method, given);
}

double checked(double limit, const char* setting)
{
    if (!std::isfinite(limit) || limit < 0.0)
        refuse_setting(setting, "must be a number of 0 or more");
    return limit;
}

SolverOptions limits_of(const BakeSettings& settings)
{
    SolverOptions solver;
    solver.method = method_of(settings);
    solver.target_error = checked(settings.error.value_or(0.0), "error");
    solver.target_dark_error = checked(settings.dark_error, "dark_error");
    solver.target_quality = {checked(settings.visible_noise, "visible_noise"),
                             checked(settings.eye_error, "eye_error")};
    solver.max_seconds = checked(settings.seconds, "seconds");
    solver.max_shots = settings.shots;
    if (!settings.error && !solver.has_target() && solver.max_seconds == 0.0 &&
        solver.max_shots == 0)
        set_default_limits(solver);
    return solver;
}

BakeOptions checked_options(const BakeSettings& settings, bool has_progress)
{
    BakeOptions options;
    options.parts = parts_of(settings.parts);
    options.solver = limits_of(settings);
    options.max_memory = settings.max_memory;
    options.preview_width = 0;
    options.atlas = checked_options(settings.atlas);
    options.atlas = atlas_that_fits(options);
    const SolverOptions& solver = options.solver;
    if (!solver.has_target() && solver.max_seconds == 0.0 && solver.max_shots == 0 && !has_progress)
        refuse_setting("error", "nothing would end the bake: set an error, seconds or shots");
    check_limits(solver);
    return options;
}

void check_materials(const MethodInfo& method, const lumel::Scene& scene)
{
    if (method.materials == MaterialModel::glossy && scene.model != MaterialModel::glossy)
        refuse_setting("method",
                       std::string(method.id) + " needs a scene loaded with Materials::glossy");
}

lumel::ProgressFunction follower(const ProgressFunction& progress)
{
    if (!progress)
        return {};
    return [&progress](const BakeProgress& now) {
        return progress({.stage = now.stage,
                         .fraction = now.fraction,
                         .shots = now.shots,
                         .error = now.error,
                         .seconds = now.seconds});
    };
}

Baked bake_scene(const gpu::Device& device, const lumel::Scene& scene, BakeOptions options,
                 const lumel::ProgressFunction& progress)
{
    const LogCapture log;
    Stages stages(progress);
    const MemoryLimits limits = memory_limits(options, device.info());
    check_memory(scene, options, limits);
    const Setting setting(scene, device, options, stages);
    options.solver.max_bytes = bytes_for_links(setting.prepared, options, limits);
    std::unique_ptr<Solution> solution = keeps_sources_apart(options)
                                             ? solve_sources(device, setting, options, stages)
                                             : solve_light(device, setting, options, stages);
    const SolverState solved = solution->solver->state();
    const SolveScene& prepared = setting.prepared;
    Baked baked;
    baked.interrupted = stages.stopped();
    stages.begin("finishing");
    tell_advice(prepared, options, *solution, stages);
    baked.map =
        map_of(finish_map(prepared.scene, prepared.atlas, prepared.lumels, solution->irradiance));
    baked.surfaces = surfaces_of(prepared.scene, prepared.atlas);
    baked.pages = pages_of(prepared.atlas);
    baked.texels_per_metre = prepared.atlas.texels_per_metre;
    // Without light there is no error.
    if (is_lit(solution->irradiance)) {
        baked.error = solved.error;
        baked.eye_error = solved.eye_error;
        baked.visible_noise = solved.visible_noise.worst_chart;
    }
    baked.shots = solved.shots;
    if (solution->relightable)
        baked.relightable = std::make_shared<RelightableBake>(RelightableBake{
            std::move(*solution->relightable), prepared.scene, prepared.atlas, prepared.lumels});
    device.check_validation();
    baked.notes = in_fields(log.messages());
    baked.seconds = stages.seconds();
    return baked;
}

}  // namespace

Baked bake(const Device& device, const Scene& scene, const BakeSettings& settings,
           const ProgressFunction& progress)
{
    return translated([&] {
        const BakeOptions options = checked_options(settings, bool(progress));
        check_materials(lumel::method_of(options.solver.method), scene.impl().scene);
        return bake_scene(device.impl().device, scene.impl().scene, options, follower(progress));
    });
}

}  // namespace lumel::v0
