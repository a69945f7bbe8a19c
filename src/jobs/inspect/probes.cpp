#include "jobs/inspect/probes.h"

#include <algorithm>
#include <filesystem>

#include "base/core/files.h"
#include "base/core/parallel.h"
#include "base/json/json_file.h"
#include "jobs/edit/finished_bake.h"
#include "jobs/inspect/probe_nodes.h"
#include "jobs/solve/stages.h"
#include "results/files/folder.h"

namespace lumel {
namespace {

/// Probes per progress report, and minimum per task.
constexpr std::size_t kProbesPerStep = 64, kProbesPerTask = 1;
/// Version of the file format, for readers.
constexpr int kVersion = 1;

ProbeGrid grid_of(const ProbesOptions& options, const SolveScene& prepared)
{
    if (const auto& b = options.bounds)
        return probe_grid({(*b)[0], (*b)[1], (*b)[2]}, {(*b)[3], (*b)[4], (*b)[5]},
                          options.spacing);
    return probe_grid(prepared.low_in_file(), prepared.high_in_file(), options.spacing);
}

void find_places(const std::string& scene, const ProbesOptions& options, const SolveScene& prepared,
                 ProbesSummary& summary)
{
    if (options.spacing > 0.0) {
        summary.grid = grid_of(options, prepared);
        for (const glm::dvec3& point : summary.grid->points())
            summary.rows.push_back({.place = {.position = point}});
    }
    for (const ProbePlace& place : probe_places(scene))
        summary.rows.push_back({.place = place});
    for (const glm::dvec3& place : options.places)
        summary.rows.push_back({.place = {.position = place}});
    if (summary.rows.empty())
        throw Error(ErrorKind::input, "lumel probes",
                    "needs --spacing or --at: no node of the scene has extras.lumel.probe");
}

void read_all(const FinishedBake& bake, const ProbesOptions& options, std::vector<ProbeRow>& rows,
              Stages& stages)
{
    const LightProbe probe(
        bake.prepared.scene, bake.prepared.rays, bake.prepared.atlas, bake.prepared.lumels,
        bake.irradiance, {.samples = options.samples, .seed = seed_of(bake.record.solver.method)});
    const bool done = parallel_steps(
        rows.size(), kProbesPerStep, kProbesPerTask,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i)
                rows[i].light =
                    probe.read(glm::vec3(rows[i].place.position - bake.prepared.scene.origin),
                               std::uint32_t(i));
        },
        [&](std::size_t count) { return stages.progress(double(count) / double(rows.size())); });
    if (!done)
        throw_stopped();
}

Json json_of(const ProbeRow& row)
{
    Json json;
    if (!row.place.name.empty())
        json["name"] = row.place.name;
    json["position"] = json_array(row.place.position);
    json["inside"] = row.light.inside;
    if (row.light.inside)
        return json;
    json["coefficients"] = coefficients_of(row.light);
    json["noise"] = row.light.noise;
    return json;
}

std::string report_of(const FinishedBake& bake, const ProbesSummary& summary)
{
    Json json;
    json["lumel_probes"] = kVersion;
    json["units"] = {{"position", "m"},
                     {"coefficients", "cd/m2, linear RGB with Rec. 709 primaries"},
                     {"noise", "cd/m2, standard error of the noisiest coefficient"}};
    json["harmonics"] = {
        {"order", kMaxBands - 1},
        {"basis", "real, orthonormal over the sphere, no Condon-Shortley sign; coefficient "
                  "l*l + l + m, red, green and blue of each in turn"},
        {"directions", "from the probe to where the light comes from; axes of the glTF: "
                       "right-handed, +Y up"},
        {"irradiance", "H(n) = sum of A_l c_lm Y_lm(n) [lx], A = pi, 2 pi / 3, pi / 4"}};
    if (bake.record.error >= 0.0)
        json["error_of_bake"] = bake.record.error;
    if (const auto& grid = summary.grid)
        json["grid"] = {{"first", json_array(grid->first)},
                        {"spacing", grid->spacing},
                        {"counts", {grid->counts.x, grid->counts.y, grid->counts.z}},
                        {"order", "the first probes of the list: x fastest, then y, then z"}};
    json["probes"] = Json::array();
    for (const ProbeRow& row : summary.rows)
        json["probes"].push_back(json_of(row));
    return json_text(json);
}

/// Computes everything except the file. scene: path of the bake's scene.
ProbesSummary found(const FinishedBake& bake, const std::string& scene,
                    const ProbesOptions& options, Stages& stages)
{
    ProbesSummary summary;
    find_places(scene, options, bake.prepared, summary);
    stages.begin("rays");
    read_all(bake, options, summary.rows, stages);
    summary.inside =
        std::size_t(std::count_if(summary.rows.begin(), summary.rows.end(),
                                  [](const ProbeRow& row) { return row.light.inside; }));
    stages.begin("writing");
    summary.report = report_of(bake, summary);
    return summary;
}

}  // namespace

Json coefficients_of(const ProbeLight& light)
{
    Json coefficients = Json::array();
    for (const glm::vec3& c : light.coefficients)
        for (const float channel : {c.r, c.g, c.b})
            coefficients.push_back(shortest(channel));
    return coefficients;
}

void check_probe_spacing(double spacing, const SolveScene& prepared)
{
    ProbesOptions options;
    options.spacing = spacing;
    try {
        grid_of(options, prepared);
    } catch (const Error&) {
        throw Error(ErrorKind::input, "--probes",
                    "would make more than a million probes; use a wider spacing");
    }
}

void add_probes(const OutputFolder& written, double spacing, const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    ProbesOptions grid;
    grid.spacing = spacing;
    const ProbesSummary summary =
        found(FinishedBake(written), written.path(kSceneFile), grid, stages);
    write_probe_nodes(written, summary.rows);
    write_text(written.path(kProbesFile), summary.report);
    stages.end();
}

ProbesSummary probes(const std::string& folder, const ProbesOptions& options,
                     const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    const std::filesystem::path path(folder);
    ProbesSummary summary =
        found(FinishedBake(folder), (path / kSceneFile).string(), options, stages);
    summary.file = options.file.empty() ? (path / kProbesFile).string() : options.file;
    OutputFile output(summary.file);
    write_text(output.path(), summary.report);
    output.commit();
    stages.end();
    return summary;
}

}  // namespace lumel
