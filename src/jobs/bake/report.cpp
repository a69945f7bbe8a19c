#include "jobs/bake/report.h"

#include "jobs/bake/reference.h"
#include "jobs/bake/report_parts.h"
#include "links/kept/links_file.h"
#include "methods/matrix/matrix_file.h"
#include "results/record/enum_names.h"

namespace lumel {

BakeRecord record_of(const BakeOptions& options, const SolveScene& prepared, const Results& results,
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
                      .compression = options.compression,
                      .baked_size = options.baked_size,
                      .given_exposure = options.exposure,
                      .keep_links = options.keep_links ? std::uint32_t(results.shots) : 0,
                      .pages = prepared.atlas.pages,
                      .texels_per_metre = double(prepared.atlas.texels_per_metre),
                      .shots = results.shots,
                      .iterations = results.iterations,
                      .error = results.error,
                      .dark_error = results.dark_error,
                      .eye_error = results.eye_error,
                      .visible_noise = results.visible_noise,
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

Report bake_report(const BakeRecord& record, const SolveScene& prepared, const gpu::Device& device,
                   const Solver& solver, const Results& results, const Stages& stages)
{
    Report report = report_of(record);
    add_facts(report, prepared, stages);
    add_solution(report, device, solver, results);
    report.directional_shots = results.directional.shots;
    add_times(report, "directional: ", results.directional.times);
    return report;
}

Report reference_report(const BakeOptions& options, const ReferenceOptions& reference,
                        const SolveScene& prepared, bool stopped, const Stages& stages)
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

}  // namespace lumel
