// The pipeline of `lumel bake`, without files.

#include "api/bake.h"

#include <cmath>

#include "api/device.h"
#include "api/scene.h"
#include "api/translate.h"
#include "api/values.h"
#include "atlas/finish/finish.h"
#include "base/core/log.h"
#include "jobs/solve/lighting.h"
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

BakeOptions checked_options(const BakeSettings& settings, bool has_progress)
{
    BakeOptions options;
    options.atlas = checked_options(settings.atlas);
    options.parts = parts_of(settings.parts);
    options.solver.method = method_of(settings);
    options.solver.target_error = settings.error;
    options.solver.target_quality = {settings.visible_noise, settings.eye_error};
    options.solver.max_seconds = settings.seconds;
    options.solver.max_shots = settings.shots;
    if (!std::isfinite(settings.error) || settings.error < 0.0)
        refuse_setting("error", "must be a number of 0 or more");
    if (!std::isfinite(settings.eye_error) || settings.eye_error < 0.0)
        refuse_setting("eye_error", "must be a number of 0 or more");
    if (!std::isfinite(settings.visible_noise) || settings.visible_noise < 0.0)
        refuse_setting("visible_noise", "must be a number of 0 or more");
    if (!std::isfinite(settings.seconds) || settings.seconds < 0.0)
        refuse_setting("seconds", "must be a number of 0 or more");
    if (!options.solver.has_target() && settings.seconds == 0.0 && settings.shots == 0 &&
        !has_progress)
        refuse_setting("error", "nothing would end the bake: set an error, seconds or shots");
    check_limits(options.solver);
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

Baked bake_scene(const gpu::Device& device, const lumel::Scene& scene, const BakeOptions& options,
                 const lumel::ProgressFunction& progress)
{
    const LogCapture log;
    Stages stages(progress);
    const Setting setting(scene, device, options, stages);
    std::unique_ptr<Solution> solution = keeps_sources_apart(options)
                                             ? solve_sources(device, setting, options, stages)
                                             : solve_light(device, setting, options, stages);
    const SolverState solved = solution->solver->state();
    const SolveScene& prepared = setting.prepared;
    Baked baked;
    baked.interrupted = stages.stopped();
    stages.begin("finishing");
    baked.map =
        map_of(finish_map(prepared.scene, prepared.atlas, prepared.lumels, solution->irradiance));
    baked.surfaces = surfaces_of(prepared.scene, prepared.atlas);
    baked.pages = pages_of(prepared.atlas);
    baked.texels_per_metre = prepared.atlas.texels_per_metre;
    baked.error = solved.error;
    baked.shots = solved.shots;
    if (solution->relightable)
        baked.relightable = std::make_shared<RelightableBake>(RelightableBake{
            std::move(*solution->relightable), prepared.scene, prepared.atlas, prepared.lumels});
    device.check_validation();
    baked.notes = log.messages();
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
