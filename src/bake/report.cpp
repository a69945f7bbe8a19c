#include "bake/report.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "core/usage.h"
#include "relight/matrix_file.h"
#include "solve/methods.h"

namespace lumel {
namespace {

const char* text_of(SampleRule rule)
{
    return rule == SampleRule::area ? "area" : "centre";
}

const char* text_of(Directional directional)
{
    return directional == Directional::none ? "none"
                                            : (directional == Directional::sh1 ? "sh1" : "sh2");
}

const char* text_of(Parts parts)
{
    return parts == Parts::all ? "all" : (parts == Parts::direct ? "direct" : "indirect");
}

const std::vector<std::string> kBakedFiles = {"lightmap.exr", "lightmap.png",    "solution.exr",
                                              "scene.glb",    "scene-baked.glb", "report.json"};

using Settings = std::vector<std::pair<std::string, std::string>>;

Report common(const Scene& scene, const Stages& stages)
{
    Report report;
    report.lumel_version = LUMEL_VERSION;
    report.scene = std::filesystem::path(scene.path).filename().string();
    report.scene_hash = scene.hash;
    report.stages = stages.times();
    report.wall_seconds = stages.seconds();
    report.cpu_seconds = cpu_seconds();
    report.peak_host_bytes = std::int64_t(peak_memory_bytes());
    report.warnings = scene.warnings;
    return report;
}

Report common(const Scene& scene, const Atlas& atlas, const Lumels& lumels, const Stages& stages)
{
    Report report = common(scene, stages);
    report.atlas_width = atlas.width;
    report.atlas_height = atlas.height;
    report.texels_per_metre = double(atlas.texels_per_metre);
    report.charts = atlas.chart_count;
    report.instances = scene.instances.size();
    report.lumels = lumels.lumels.size();
    report.pieces = lumels.pieces.size();
    for (const Surface& surface : atlas.surfaces)
        report.triangles += surface.indices.size() / 3;
    for (const Lumel& lumel : lumels.lumels)
        report.buried_lumels += (lumel.flags & kLumelBuried) != 0;
    report.notes = atlas.notes;
    return report;
}

Report common(const Prepared& world, const Stages& stages)
{
    return common(world.scene, world.atlas, world.lumels, stages);
}

void add_device(Report& report, const gpu::Device& device)
{
    report.device = device.info().name;
    report.driver = device.info().driver;
    report.vulkan = device.info().api_version;
    report.peak_gpu_bytes = std::int64_t(device.peak_bytes());
}

/// Of the options that the method reads.
Settings settings_of(const MethodOptions& method)
{
    Settings settings;
    for (const OptionInfo& option : method_of(method).options)
        settings.emplace_back(option.name, option.get(method));
    return settings;
}

Settings settings_of(const BakeOptions& options)
{
    Settings settings = settings_of(options.solver.method);
    for (const auto& setting :
         Settings{{"sky-directions", std::to_string(options.sky_directions)},
                  {"shots", std::to_string(options.solver.max_shots)},
                  {"time", fmt::format("{}", options.solver.max_seconds)},
                  {"error", fmt::format("{}", 100.0 * options.solver.target_error)},
                  {"gutter", std::to_string(options.atlas.gutter)},
                  {"max-size", std::to_string(options.atlas.max_size)}})
        settings.push_back(setting);
    return settings;
}

void append(Settings& settings, const Settings& more)
{
    settings.insert(settings.end(), more.begin(), more.end());
}

/// Adds what stages took on the device, their names after `before`.
void add_times(Report& report, const std::string& before, const gpu::StageTimes& times)
{
    for (const auto& [stage, ms] : times)
        report.gpu_milliseconds.emplace_back(before + stage, std::vector<double>{ms});
}

/// What all solvers have to say, whatever is made of the solution.
Report solved(const BakeOptions& options, const Prepared& world, const gpu::Device& device,
              const Solver& solver, const Results& results, const Stages& stages)
{
    Report report = common(world, stages);
    report.settings = settings_of(options);
    append(report.settings, settings_of(options.lights));
    report.settings.emplace_back("near-field-pairs", std::to_string(results.near_pairs));
    report.seed = seed_of(options.solver.method);
    add_device(report, device);
    report.method = method_of(options.solver.method).id;
    report.shots = results.shots;
    report.iterations = results.iterations;
    report.estimated_error = results.error;
    report.interrupted = results.interrupted;
    report.convergence = results.curve;
    report.form_factors = results.form_factors;
    if (!results.lamps.finished)
        report.notes.emplace_back(
            "stopped before all light of sky and lamps was found; some of it is missing");
    add_times(report, "sky and lamps: ", results.lamps.times);
    add_times(report, "", solver.times());
    report.gpu_milliseconds.emplace_back("longest submission",
                                         std::vector<double>{solver.longest_submission()});
    return report;
}

/// Adds what a picture is of.
void add_picture(Report& report, const RenderOptions& options, const Settings& settings)
{
    report.picture_width = options.width;
    report.picture_height = options.height;
    if (options.camera >= 0)
        report.settings.emplace_back("camera", std::to_string(options.camera));
    report.settings.insert(report.settings.end(), settings.begin(), settings.end());
}

}  // namespace

Report bake_report(const BakeOptions& options, const Prepared& world, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages)
{
    Report report = solved(options, world, device, solver, results, stages);
    report.settings.emplace_back("only", text_of(options.parts));
    report.settings.emplace_back("half", options.half ? "true" : "false");
    report.settings.emplace_back("directional", text_of(options.directional));
    report.directional_shots = results.directional.shots;
    add_times(report, "directional: ", results.directional.times);
    report.files = kBakedFiles;
    if (options.preview_width > 0)
        report.files.emplace_back("preview.png");
    if (results.relightable)
        report.files.emplace_back(kMatrixFile);
    return report;
}

Report update_report(const UpdateOptions& options, const BakedFolder& baked, const UpdateRow& row,
                     const Prepared& world, const gpu::Device* device, const Stages& stages)
{
    Report report = common(world, stages);
    const Settings lights_before = settings_of(baked.lights);
    for (const auto& entry : baked.settings)
        if (std::find(lights_before.begin(), lights_before.end(), entry) == lights_before.end())
            report.settings.push_back(entry);
    append(report.settings, settings_of(options.lights));
    report.seed = baked.seed;
    if (device)
        add_device(report, *device);
    report.method = baked.method;
    report.shots = baked.shots;
    report.iterations = baked.iterations;
    if (row.solved_anew)
        report.estimated_error = row.residual;
    else if (baked.error >= 0.0)
        report.estimated_error = std::hypot(baked.error, row.residual);
    report.interrupted = stages.stopped();
    report.update = row;
    report.files = kBakedFiles;
    if (device && options.preview_width > 0)
        report.files.emplace_back("preview.png");
    return report;
}

Report reference_report(const LightOptions& lights, const ReferenceOptions& reference,
                        const Prepared& world, bool stopped, const Stages& stages)
{
    Report report = common(world, stages);
    report.method = "reference";
    report.settings = {{"spp", std::to_string(reference.samples_per_lumel)},
                       {"sampling", text_of(reference.rule)},
                       {"gloss", world.scene.model == MaterialModel::glossy ? "true" : "false"},
                       {"only", text_of(reference.parts)}};
    append(report.settings, settings_of(lights));
    report.seed = reference.seed;
    report.interrupted = stopped;
    report.files = {"lightmap.exr", "lightmap.png", "report.json"};
    return report;
}

Report picture_report(const RenderOptions& options, const Prepared& world,
                      const gpu::Device& device, const Solver& solver, const Results& results,
                      const Stages& stages)
{
    Report report = solved(options.bake, world, device, solver, results, stages);
    add_picture(report, options,
                {{"places", std::to_string(options.sets)},
                 {"eye-shots", std::to_string(options.shots)},
                 {"lobe-rays", std::to_string(options.rays)}});
    return report;
}

Report play_report(const PlayOptions& options, const LiveScene& live, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages)
{
    Report report = common(live.scene(), live.atlas(), live.lumels(), stages);
    add_device(report, device);
    const bool crosses = options.redistribution == Redistribution::cross;
    report.settings = {{"redistribution", crosses ? "cross" : "incremental"},
                       {"animation", std::to_string(options.animation)},
                       {"frames", std::to_string(options.frames)},
                       {"fps", fmt::format("{}", options.fps)},
                       {"budget", fmt::format("{}", options.budget_ms)},
                       {"residual", fmt::format("{}", 100.0 * options.residual)},
                       {"exposure", fmt::format("{}", options.exposure)},
                       {"gutter", std::to_string(options.atlas.gutter)},
                       {"max-size", std::to_string(options.atlas.max_size)}};
    append(report.settings, settings_of(MethodOptions(options.solver)));
    report.method = method_of(MethodOptions(options.solver)).id;
    for (const FrameRow& frame : frames)
        report.shots += frame.hemicubes;
    report.frames = std::move(frames);
    report.interrupted = stages.stopped();
    report.picture_width = options.width;
    report.picture_height = height;
    add_times(report, "", live.times());
    return report;
}

Report path_traced_report(const RenderOptions& options, const Scene& scene, const Stages& stages)
{
    Report report = common(scene, stages);
    report.method = "reference";
    add_picture(report, options, {{"paths", std::to_string(options.paths)}});
    append(report.settings, settings_of(options.bake.lights));
    report.seed = seed_of(options.bake.solver.method);
    report.interrupted = stages.stopped();
    return report;
}

}  // namespace lumel
