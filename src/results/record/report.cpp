#include "results/record/report.h"

#include <algorithm>
#include <numeric>

#include "base/json/json_file.h"

namespace lumel {
namespace {

// Units of the numbers in the other files.
Json map_units(bool directional, int pages)
{
    Json json = {
        {"length", "m"},
        {"irradiance", "lx"},
        {"radiance", "cd/m2"},
        {"color_space", "linear Rec. 709"},
        {"lightmap.exr", "irradiance H [lx] in RGB, not divided by pi; alpha is the covered "
                         "fraction of each texel, 0: not covered"},
        {"lightmap.png", "tone-mapped for display, sRGB"},
        {"solution.exr",
         "irradiance of lumels as solved [lx]: fronts in RGB, backs in layer back; "
         "open fractions of their areas in layer open, R and G; errors that links estimate "
         "for the map's texels, relative to their light, in layer error, R; alpha is the number "
         "of the chart, from 1"},
        {"scene.glb", "MOZ_lightmap: reflected radiance = albedo / pi x texel x intensity, "
                      "texel linear, intensity in lx"},
        {"scene-baked.glb", "tone-mapped radiance as emissive colour, sRGB"},
        {"texture_coordinates", "TEXCOORD_1, (0, 0) at the top left corner"}};
    if (pages > 1)
        json["pages"] = "lightmap-0.exr and so on are pages of equal density; "
                        "extras.lumel.page of a material of scene.glb names its own";
    if (directional)
        json["lightmap.exr, layers sh.i"] =
            "coefficient i = l*l + l + m of incoming radiance [cd/m2], orthonormal real spherical "
            "harmonics, world axes of the glTF; H(n) = sum of A_l sh.i Y_lm(n), A = pi, 2 pi / 3, "
            "pi / 4";
    return json;
}

Json picture_units()
{
    return {{"radiance", "cd/m2"},
            {"color_space", "linear Rec. 709"},
            {"exr", "radiance toward the eye [cd/m2] in RGB, multiplied by alpha, the covered "
                    "fraction of the pixel"},
            {"png", "tone-mapped for display, sRGB"}};
}

Json gpu_times(const Report& report)
{
    Json passes = Json::object();
    for (const auto& [name, runs] : report.gpu_milliseconds) {
        if (runs.empty())
            continue;
        passes[name] = {{"runs", runs.size()},
                        {"total_ms", std::accumulate(runs.begin(), runs.end(), 0.0)},
                        {"least_ms", *std::min_element(runs.begin(), runs.end())},
                        {"most_ms", *std::max_element(runs.begin(), runs.end())}};
    }
    return passes;
}

Json timings(const Report& report)
{
    Json stages = Json::array();
    for (const StageTime& stage : report.stages)
        stages.push_back({{"stage", stage.name},
                          {"wall_seconds", stage.wall_seconds},
                          {"cpu_seconds", stage.cpu_seconds}});
    return {{"wall_seconds", report.wall_seconds},
            {"cpu_seconds", report.cpu_seconds},
            {"stages", stages},
            {"gpu", gpu_times(report)}};
}

Json ranks(const Report& report)
{
    Json rows = Json::array();
    for (const RankCost& rank : report.ranks)
        rows.push_back({{"working_seconds", rank.working},
                        {"waiting_seconds", rank.waiting},
                        {"received_bytes", rank.bytes},
                        {"messages", rank.messages}});
    return rows;
}

Json solution(const Report& report)
{
    Json curve = Json::array();
    for (const ConvergencePoint& point : report.convergence)
        curve.push_back(
            {{"shots", point.shots}, {"seconds", point.seconds}, {"error", point.error}});
    Json result = {{"shots", report.shots},
                   {"iterations", report.iterations},
                   {"interrupted", report.interrupted}};
    if (report.directional_shots > 0)
        result["directional_shots"] = report.directional_shots;
    if (!report.rays.empty())
        result["rays"] = report.rays;
    if (report.estimated_error >= 0.0)
        result["estimated_error"] = report.estimated_error;
    if (report.estimated_dark_error >= 0.0)
        result["estimated_dark_error"] = report.estimated_dark_error;
    if (report.estimated_eye_error >= 0.0)
        result["estimated_eye_error"] = report.estimated_eye_error;
    if (report.visible_noise.worst_chart >= 0.0)
        result["visible_noise"] = {{"bands", report.visible_noise.bands},
                                   {"worst_chart", report.visible_noise.worst_chart}};
    if (report.exposure)
        result["exposure"] = shortest(*report.exposure);
    result["convergence"] = curve;
    return result;
}

Json frames(const Report& report)
{
    Json rows = Json::array();
    for (const FrameRow& frame : report.frames) {
        Json& row = rows.emplace_back(
            Json{{"file", frame.file}, {"time_s", frame.seconds}, {"update_ms", frame.update_ms}});
        if (frame.links)
            row.update({{"links", frame.links->retraced},
                        {"direct", frame.links->direct},
                        {"sweeps", frame.links->sweeps}});
        else
            row["hemicubes"] = frame.hemicubes;
        if (frame.links && frame.links->error >= 0.0)
            row["estimated_error"] = frame.links->error;
        row.update({{"residual", frame.residual}, {"at_rest", frame.at_rest}});
    }
    return rows;
}

Json form_factors(const FormFactorRow& row)
{
    return {{"patches", row.patches},
            {"voxel_metres", row.voxel},
            {"closed_rows", row.closed},
            {"row_sum_error", row.row_sum},
            {"worst_row_sum_error", row.worst_row_sum},
            {"reciprocity_error", row.reciprocity}};
}

Json update(const UpdateRow& row)
{
    Json json = {{"moved", row.moved},         {"appeared", row.appeared},
                 {"vanished", row.vanished},   {"recoloured", row.recoloured},
                 {"relit", row.relit},         {"rays", row.rays},
                 {"particles", row.particles}, {"solved_anew", row.solved_anew},
                 {"residual", row.residual}};
    if (row.error_before >= 0.0)
        json["error_before"] = row.error_before;
    if (row.links > 0)
        json["links"] = row.links;
    return json;
}

Json preview(const PreviewRow& row)
{
    return {{"eye", {row.eye.x, row.eye.y, row.eye.z}},
            {"direction", {row.direction.x, row.direction.y, row.direction.z}},
            {"vertical_fov", row.vertical_fov}};
}

Json sizes(const Report& report)
{
    Json json = Json::object();
    if (report.picture_width > 0)
        json = {{"picture_width", report.picture_width}, {"picture_height", report.picture_height}};
    if (report.atlas_width > 0)
        json.update({{"atlas_width", report.atlas_width},
                     {"atlas_height", report.atlas_height},
                     {"texels_per_metre", report.texels_per_metre},
                     {"instances", report.instances},
                     {"triangles", report.triangles},
                     {"charts", report.charts},
                     {"lumels", report.lumels},
                     {"buried_lumels", report.buried_lumels},
                     {"pieces", report.pieces}});
    if (report.pages > 1)
        json["pages"] = report.pages;
    if (report.near_pairs)
        json["near_field_pairs"] = *report.near_pairs;
    return json;
}

Json memory(const Report& report)
{
    Json bytes = Json::object();
    if (report.peak_host_bytes >= 0)
        bytes["peak_host_bytes"] = report.peak_host_bytes;
    if (report.peak_gpu_bytes >= 0)
        bytes["peak_gpu_bytes"] = report.peak_gpu_bytes;
    return bytes;
}

template <class Texts>
Json members(const Texts& texts)
{
    Json result = Json::object();
    for (const auto& [name, text] : texts)
        if (!text.empty())
            result[name] = text;
    return result;
}

}  // namespace

Json to_json(const Report& report)
{
    using Texts = std::vector<std::pair<std::string, std::string>>;
    Json json;
    json["format"] = kReportFormat;
    json["lumel"] = report.lumel_version;
    if (!report.date.empty())
        json["date"] = report.date;
    json["libraries"] = members(report.library_versions);
    json["scene"] = members(Texts{{"file", report.scene}, {"hash", report.scene_hash}});
    json["settings"] = report.settings;
    if (report.lights)
        json["lights"] = *report.lights;
    if (report.solver)
        json["solver"] = *report.solver;
    json["device"] = members(
        Texts{{"name", report.device}, {"driver", report.driver}, {"vulkan", report.vulkan}});
    json["sizes"] = sizes(report);
    json["solution"] = solution(report);
    if (!report.frames.empty())
        json["frames"] = frames(report);
    if (report.form_factors)
        json["form_factors"] = form_factors(*report.form_factors);
    if (report.update)
        json["update"] = update(*report.update);
    if (report.preview)
        json["preview"] = preview(*report.preview);
    json["timings"] = timings(report);
    json["memory"] = memory(report);
    if (!report.ranks.empty())
        json["ranks"] = ranks(report);
    json["units"] = report.picture_width > 0
                        ? picture_units()
                        : map_units(report.directional_shots > 0, report.pages);
    json["files"] = report.files;
    json["warnings"] = report.warnings;
    json["notes"] = report.notes;
    return json;
}

}  // namespace lumel
