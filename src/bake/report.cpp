#include "bake/report.h"

#include <cmath>
#include <filesystem>

#include "bake/reference.h"
#include "core/usage.h"
#include "live/links_file.h"
#include "record/light_settings.h"
#include "record/origin.h"
#include "record/solver_settings.h"
#include "record/words.h"
#include "relight/matrix_file.h"
#include "solve/methods.h"

namespace lumel {
namespace {

std::vector<std::string> files_of_map(const Pages& pages)
{
    std::vector<std::string> files;
    for (const char* ending : {".exr", ".png"})
        for (int page = 0; page < pages.count; ++page)
            files.push_back(page_name(pages, page, kLightmapName) + ending);
    return files;
}

std::vector<std::string> baked_files(const Pages& pages)
{
    std::vector<std::string> files = files_of_map(pages);
    files.insert(files.end(), {kSolutionFile, kSceneFile, "scene-baked.glb", kReportFile});
    return files;
}

std::string file_of(const Scene& scene)
{
    return std::filesystem::path(scene.path).filename().string();
}

/// A report of something that is no bake.
Report report_on(const Scene& scene, const LightOptions& lights)
{
    Report report;
    report.lumel_version = lumel_version();
    report.date = local_time();
    report.library_versions = library_versions();
    report.scene = file_of(scene);
    report.scene_hash = scene.hash;
    report.lights = light_settings(lights);
    return report;
}

/// Adds what the work took.
void add_usage(Report& report, const Scene& scene, const Stages& stages)
{
    report.stages = stages.times();
    report.wall_seconds = stages.seconds();
    report.cpu_seconds = cpu_seconds();
    report.peak_host_bytes = std::int64_t(peak_memory_bytes());
    report.warnings = scene.warnings;
    report.warnings.insert(report.warnings.end(), stages.warnings().begin(),
                           stages.warnings().end());
}

void add_sizes(Report& report, const Scene& scene, const Atlas& atlas, const Lumels& lumels)
{
    report.atlas_width = atlas.width;
    report.atlas_height = atlas.height;
    report.pages = atlas.pages.count;
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
}

void add_facts(Report& report, const Prepared& prepared, const Stages& stages)
{
    add_usage(report, prepared.scene, stages);
    add_sizes(report, prepared.scene, prepared.atlas, prepared.lumels);
    report.notes.insert(report.notes.end(), stages.told().begin(), stages.told().end());
}

void add_device(Report& report, const gpu::Device& device)
{
    report.device = device.info().name;
    report.driver = device.info().driver;
    report.vulkan = device.info().api_version;
    report.peak_gpu_bytes = std::int64_t(device.peak_bytes());
}

/// Adds what stages took on the device, their names after `before`.
void add_times(Report& report, const std::string& before, const gpu::StageTimes& times)
{
    for (const auto& [stage, ms] : times)
        report.gpu_milliseconds.emplace_back(before + stage, std::vector<double>{ms});
}

/// Adds what all solvers have to say, whatever is made of the solution.
void add_solution(Report& report, const gpu::Device& device, const Solver& solver,
                  const Results& results)
{
    add_device(report, device);
    report.near_pairs = results.near_pairs;
    report.shots = results.shots;
    report.iterations = results.iterations;
    report.rays = solver.rays();
    report.estimated_error = results.error;
    report.estimated_dark_error = results.dark_error;
    report.interrupted = results.interrupted;
    report.convergence = results.curve;
    report.form_factors = results.form_factors;
    add_times(report, "sky and lamps: ", results.lamps.times);
    add_times(report, "", solver.times());
    report.gpu_milliseconds.emplace_back("longest submission",
                                         std::vector<double>{solver.longest_submission()});
}

/// Adds what a picture is of.
void add_picture(Report& report, const RenderOptions& options)
{
    report.picture_width = options.width;
    report.picture_height = options.height;
    if (options.camera >= 0)
        report.settings["camera"] = options.camera;
}

Json path_tracer_settings(std::uint32_t seed)
{
    return {{"method", "reference"}, {"options", {{"seed", seed}}}};
}

}  // namespace

BakeRecord record_of(const BakeOptions& options, const Prepared& prepared, const Results& results,
                     const WrittenLight& written)
{
    BakeRecord record{.scene = file_of(prepared.scene),
                      .scene_hash = prepared.scene.hash,
                      .lights = options.lights,
                      .atlas = options.atlas,
                      .solver = options.solver,
                      .sky_directions = options.sky_directions,
                      .parts = options.parts,
                      .directional = options.directional,
                      .half = options.half,
                      .keep_lights = options.keep_lights,
                      .lightmap_format = options.lightmap_format,
                      .baked_size = options.baked_size,
                      .keep_links = options.keep_links,
                      .pages = prepared.atlas.pages,
                      .texels_per_metre = double(prepared.atlas.texels_per_metre),
                      .shots = results.shots,
                      .iterations = results.iterations,
                      .error = results.error,
                      .dark_error = results.dark_error,
                      .interrupted = results.interrupted,
                      .exposure = written.exposure,
                      .files = baked_files(prepared.atlas.pages)};
    if (written.view)
        record.files.emplace_back(kPreview);
    if (results.relightable)
        record.files.emplace_back(kMatrixFile);
    if (record.keep_links > 0)
        record.files.emplace_back(kLinksFile);
    return record;
}

std::optional<PreviewRow> preview_row(const WrittenLight& written, const Scene& scene)
{
    if (!written.view)
        return std::nullopt;
    const glm::mat4& camera = written.view->transform;
    return PreviewRow{.eye = glm::dvec3(camera[3]) + scene.origin,
                      .direction = -glm::normalize(glm::dvec3(camera[2])),
                      .vertical_fov = glm::degrees(double(written.view->vertical_fov))};
}

BakeRecord corrected(BakeRecord baked, const UpdateOptions& options, const UpdateRow& row,
                     const Prepared& prepared, const std::optional<WrittenLight>& written,
                     bool interrupted)
{
    baked.scene = file_of(prepared.scene);
    baked.scene_hash = prepared.scene.hash;
    baked.lights = options.lights;
    baked.pages = prepared.atlas.pages;
    baked.texels_per_metre = double(prepared.atlas.texels_per_metre);
    if (row.solved_anew)
        baked.error = row.residual;
    else if (baked.error >= 0.0)
        baked.error = std::hypot(baked.error, row.residual);
    baked.interrupted = interrupted;
    if (written)
        baked.exposure = written->exposure;
    baked.files = baked_files(prepared.atlas.pages);
    if (written && written->view)
        baked.files.emplace_back(kPreview);
    if (baked.keep_links > 0)
        baked.files.emplace_back(kLinksFile);
    return baked;
}

Report bake_report(const BakeRecord& record, const Prepared& prepared, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages)
{
    Report report = report_of(record);
    add_facts(report, prepared, stages);
    add_solution(report, device, solver, results);
    report.directional_shots = results.directional.shots;
    add_times(report, "directional: ", results.directional.times);
    return report;
}

Report update_report(const BakeRecord& record, const UpdateRow& row, const Prepared& prepared,
                     const gpu::Device* device, const Stages& stages)
{
    Report report = report_of(record);
    add_facts(report, prepared, stages);
    if (device)
        add_device(report, *device);
    report.update = row;
    return report;
}

Report reference_report(const BakeOptions& options, const ReferenceOptions& reference,
                        const Prepared& prepared, bool stopped, const Stages& stages)
{
    Report report = report_on(prepared.scene, options.lights);
    add_facts(report, prepared, stages);
    report.settings = atlas_settings(options.atlas);
    report.settings["half"] = options.half;
    report.settings["spp"] = reference.samples_per_lumel;
    report.settings["sampling"] = word_of(reference.rule);
    report.settings["gloss"] = prepared.scene.model == MaterialModel::glossy;
    report.settings["only"] = word_of(reference.parts);
    report.solver = path_tracer_settings(reference.seed);
    report.interrupted = stopped;
    report.files = files_of_map(prepared.atlas.pages);
    report.files.emplace_back(kReportFile);
    return report;
}

Report picture_report(const RenderOptions& options, const Prepared& prepared,
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
    report.settings["eye-shots"] = options.shots;
    report.settings["lobe-rays"] = options.rays;
    report.solver = solver_settings(options.bake.solver);
    return report;
}

Report play_report(const PlayOptions& options, const Played& played, const gpu::Device& device,
                   int height, std::vector<FrameRow> frames, const Stages& stages)
{
    Report report = report_on(played.scene, {});
    add_usage(report, played.scene, stages);
    add_sizes(report, played.scene, played.atlas, played.lumels);
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
        for (const char* unread : {"sampling", "rays"})
            (*report.solver)["options"].erase(unread);
    } else
        report.settings["redistribution"] =
            options.redistribution == Redistribution::cross ? "cross" : "incremental";
    report.settings.update(atlas_settings(options.atlas));
    report.shots = played.shots;
    report.frames = std::move(frames);
    report.interrupted = stages.stopped();
    report.exposure = options.exposure;
    report.picture_width = options.width;
    report.picture_height = height;
    add_times(report, "", played.times);
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
