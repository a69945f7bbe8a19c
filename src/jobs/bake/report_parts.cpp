#include "jobs/bake/report_parts.h"

#include <filesystem>

#include "base/core/usage.h"
#include "methods/methods.h"
#include "results/record/light_settings.h"
#include "results/record/origin.h"

namespace lumel {

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

void add_facts(Report& report, const SolveScene& prepared, const Stages& stages)
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

void add_times(Report& report, const std::string& before, const gpu::StageTimes& times)
{
    for (const auto& [stage, ms] : times)
        report.gpu_milliseconds.emplace_back(before + stage, std::vector<double>{ms});
}

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
    report.estimated_eye_error = results.eye_error;
    report.visible_noise = results.visible_noise;
    report.interrupted = results.interrupted;
    report.convergence = results.curve;
    report.ranks = results.ranks;
    report.form_factors = results.form_factors;
    add_times(report, "sky and lamps: ", results.lamps.times);
    add_times(report, "", solver.times());
    report.gpu_milliseconds.emplace_back("longest submission",
                                         std::vector<double>{solver.longest_submission()});
}

Json path_tracer_settings(std::uint32_t seed)
{
    return {{"method", "reference"}, {"options", {{"seed", seed}}}};
}

}  // namespace lumel
