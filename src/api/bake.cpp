// The pipeline of `lumel bake`, without files.

#include "api/bake.h"

#include <cmath>

#include "api/device.h"
#include "api/scene.h"
#include "api/translate.h"
#include "api/values.h"
#include "api/warnings.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/log.h"
#include "jobs/bake/advice.h"
#include "jobs/bake/bake.h"
#include "jobs/bake/daylight.h"
#include "jobs/bake/directional_layers.h"
#include "jobs/bake/lamp_maps.h"
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

/// Runs work(); what it refuses names the setting, too.
template <class Work>
auto refused_by(const std::string& setting, const Work& work)
{
    try {
        return work();
    } catch (const lumel::Error& error) {
        throw lumel::Error(error.kind(), "BakeSettings::" + setting, error.what());
    }
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

lumel::Directional directional_of(Directional directional)
{
    switch (directional) {
    case Directional::sh1:
        return lumel::Directional::sh1;
    case Directional::sh2:
        return lumel::Directional::sh2;
    default:
        return lumel::Directional::none;
    }
}

BakeOptions checked_options(const BakeSettings& settings, bool has_progress)
{
    BakeOptions options;
    options.parts = parts_of(settings.parts);
    options.directional = directional_of(settings.directional);
    options.daylight = settings.weather_file;
    check_parts(options);
    options.solver = limits_of(settings);
    std::vector<lumel::LampGroup> groups;
    for (const LampGroup& group : settings.groups)
        groups.push_back({group.name, group.pattern});
    set_per_lamp(options, settings.per_lamp, std::move(groups));
    options.max_memory = settings.max_memory;
    options.preview_width = 0;
    options.atlas = checked_options(settings.atlas);
    options.atlas = atlas_that_fits(options);
    const SolverOptions& solver = options.solver;
    if (!solver.has_target() && solver.max_seconds == 0.0 && solver.max_shots == 0 && !has_progress)
        refuse_setting("error", "nothing would end the bake: set an error, seconds or shots");
    check_limits(solver);
    refused_by(options.daylight.empty() ? "method" : "weather_file",
               [&] { open_libraries(options); });
    return options;
}

void check_materials(const MethodInfo& method, const lumel::Scene& scene)
{
    if (method.materials == MaterialModel::glossy && scene.model != MaterialModel::glossy)
        refuse_setting("method",
                       std::string(method.id) + " needs a scene loaded with Materials::glossy");
}

void check_device(const BakeOptions& options)
{
    const auto* links = std::get_if<LinksOptions>(&options.solver.method);
    if (links && links->rays != Rays::automatic && links->rays != Rays::host)
        refuse_setting("options[\"rays\"]", "needs a Device for rays that are not \"host\"");
    if (options.directional != lumel::Directional::none)
        refuse_setting("directional", "needs a Device");
    if (needs_world(options))
        refuse_setting("method", std::string(lumel::method_of(options.solver.method).id) +
                                     " needs a Device; without one only \"links\" runs");
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

/// The maps of a bake; adds its directional maps.
Map finished_map(const gpu::Device* device, const BakedSolution& baked, const BakeOptions& options,
                 std::uint64_t shots, Stages& stages, std::vector<Map>& layers)
{
    const SolveScene& prepared = baked.setting.prepared;
    DirectionalLight light;
    if (options.directional != lumel::Directional::none) {
        stages.begin("directional light");
        light = gather_directional(*device, *baked.setting.world, prepared.scene, prepared.rays,
                                   prepared.lumels, baked.setting.near, baked.irradiance,
                                   directional_options(options, shots),
                                   [&](double fraction) { return stages.progress(fraction); });
    }
    stages.begin("finishing");
    DirectionalMaps maps = finish_directional(prepared, baked.irradiance, light.coefficients);
    for (Layer& layer : maps.layers)
        layers.push_back(map_of(std::move(layer.image)));
    return map_of(std::move(maps.light));
}

/// The map of each lamp, if they are kept apart.
std::vector<LampMap> maps_of_lamps(const BakedSolution& baked, Solver& solver, Stages& stages)
{
    const std::optional<LampLights> found = keep_lamps_apart(solver, stages);
    if (!found)
        return {};
    std::vector<LampMap> lamps;
    FinishedMaps maps = lamp_maps(baked.setting.prepared, baked.irradiance, found->light);
    for (std::size_t k = 0; k < found->lamps.size(); ++k) {
        const glm::dvec3 color = lamp_colour(found->light[k].irradiance);
        lamps.push_back({.name = found->lamps[k].name,
                         .kind = found->lamps[k].kind,
                         .members = found->lamps[k].members,
                         .map = map_of(std::move(maps.layers[k])),
                         .error = found->light[k].error,
                         .color = {color.r, color.g, color.b}});
    }
    return lamps;
}

std::optional<DaylightMaps> maps_of_daylight(const BakedSolution& baked,
                                             const WantedDaylight& wanted,
                                             const BakeOptions& options, Stages& stages)
{
    const SolveScene& prepared = baked.setting.prepared;
    const std::optional<lumel::DaylightMaps> found =
        make_daylight_maps(wanted, prepared, options.atlas, baked.seed, stages);
    if (!found)
        return std::nullopt;
    const Weather& weather = wanted.weather();
    DaylightMaps daylight{.place = weather.city,
                          .latitude = weather.latitude,
                          .longitude = weather.longitude,
                          .error = found->error,
                          .maps = {},
                          .hours = {}};
    std::vector<Image> images = finish_daylight(prepared, *found, baked.irradiance);
    for (std::size_t k = 0; k < images.size(); ++k)
        daylight.maps.push_back(
            {.hour = wanted.name(found->hours[k]), .map = map_of(std::move(images[k]))});
    for (const HourOfDaylight& hour : hours_with_light(wanted, *found))
        daylight.hours.push_back({.hour = hour.name,
                                  .sun = {hour.sun.x, hour.sun.y, hour.sun.z},
                                  .lux = hour.lux,
                                  .mean = hour.mean,
                                  .error = hour.error,
                                  .weights = {hour.weights.begin(), hour.weights.end()}});
    return daylight;
}

/// Frees what only the solver needed.
void reduce(Setting& setting)
{
    setting.world.reset();
    setting.particles.reset();
    setting.near = {};
}

/// Messages of a bake; on_warning()'s function has had those of the scene.
std::vector<std::string> notes_of(const LogCapture& log, const SceneImpl& scene)
{
    return told(log.messages(), scene.scene.warnings);
}

/// device: null if there is none. Logs messages for the user.
Baked baked_scene(const gpu::Device* device, const SceneImpl& given, BakeOptions options,
                  const lumel::ProgressFunction& progress)
{
    Stages stages(progress);
    const std::optional<WantedDaylight> wanted =
        refused_by("weather_file", [&] { return wanted_daylight(options, stages); });
    lumel::Scene scene = given.scene;
    warn_if_dark(scene);
    const MemoryLimits limits = memory_limits(options, device);
    check_memory(scene, options, limits);
    const auto kept =
        std::make_shared<BakedSolution>(std::move(scene), given.document, device, options, stages);
    const SolveScene& prepared = kept->setting.prepared;
    if (wanted)
        wanted->check_memory(prepared, options, limits.host);
    limit_links(options, prepared, limits);
    std::unique_ptr<Solution> solution =
        keeps_sources_apart(options) ? solve_sources(*device, kept->setting, options, stages)
                                     : solve_light(device, kept->setting, options, stages);
    const SolverState solved = solution->solver->state();
    tell_advice(prepared, options, *solution, stages);
    kept->irradiance = std::move(solution->irradiance);
    kept->light = std::move(solution->relightable);
    Baked baked;
    baked.map = finished_map(device, *kept, options, solved.shots, stages, baked.directional);
    baked.lamps = maps_of_lamps(*kept, *solution->solver, stages);
    baked.surfaces = surfaces_of(prepared.scene, prepared.atlas);
    baked.pages = pages_of(prepared.atlas);
    baked.texels_per_metre = prepared.atlas.texels_per_metre;
    // Without light there is no error.
    if (is_lit(kept->irradiance)) {
        baked.error = solved.error;
        baked.eye_error = solved.eye_error;
        baked.visible_noise = solved.visible_noise.worst_chart;
    }
    baked.shots = solved.shots;
    baked.relightable = kept->light.has_value();
    solution.reset();
    reduce(kept->setting);
    if (wanted)
        baked.daylight = maps_of_daylight(*kept, *wanted, options, stages);
    baked.interrupted = stages.stopped();
    baked.solution = kept;
    if (device)
        device->check_validation();
    baked.seconds = stages.seconds();
    return baked;
}

Baked bake_scene(const gpu::Device* device, const SceneImpl& scene, const BakeOptions& options,
                 const lumel::ProgressFunction& progress)
{
    const LogCapture log;
    try {
        Baked baked = baked_scene(device, scene, options, progress);
        baked.notes = notes_of(log, scene);
        return baked;
    } catch (...) {
        notes_of(log, scene);
        throw;
    }
}

}  // namespace

Baked bake(const Device& device, const Scene& scene, const BakeSettings& settings,
           const ProgressFunction& progress)
{
    return translated([&] {
        const BakeOptions options = checked_options(settings, bool(progress));
        check_materials(lumel::method_of(options.solver.method), scene.impl().scene);
        return bake_scene(&device.impl().device, scene.impl(), options, follower(progress));
    });
}

Baked bake(const Scene& scene, const BakeSettings& settings, const ProgressFunction& progress)
{
    return translated([&] {
        const BakeOptions options = checked_options(settings, bool(progress));
        check_device(options);
        return bake_scene(nullptr, scene.impl(), options, follower(progress));
    });
}

}  // namespace lumel::v0
