#include "jobs/relight/relight_links.h"

#include <filesystem>

#include "atlas/finish/finish.h"
#include "base/core/usage.h"
#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "jobs/edit/kept_solution.h"
#include "jobs/relight/states_file.h"
#include "lights/scene_lights.h"
#include "links/kept/links_file.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"
#include "results/record/light_settings.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// Files of a bake with --keep-links.
struct Baked {
    BakeRecord record;
    StoredLinks links;
    Scene scene;
};

Baked read(const std::string& folder)
{
    const ResultsLock as_it_is(folder);
    const std::string path = (fs::path(folder) / kLinksFile).string();
    BakeRecord record = read_bake_record(folder);
    check_light_files(record.lights);
    StoredLinks links = read_links(path);
    check_links(links, record, path);
    Scene scene =
        read_scene((fs::path(folder) / kSceneFile).string(), MaterialModel::diffuse, record.lights);
    scene.hash = record.scene_hash;  // its vertices are split, its light is the same
    return {std::move(record), std::move(links), std::move(scene)};
}

std::string report_of(const RelightSummary& summary, std::uint64_t traced,
                      const SceneLights& lights, const Baked& baked)
{
    Json json;
    json["lumel"] = lumel_version();
    json["links"] = {{"scene_hash", baked.record.scene_hash},
                     {"lumels", baked.links.lumels.size()},
                     {"rays", baked.links.shots()},
                     {"traced_again", traced},
                     {"sources", lights.names()}};
    json["seconds"] = summary.seconds;
    json["states"] = json_of(summary.states);
    return json_text(json);
}

}  // namespace

bool keeps_links(const std::string& folder)
{
    std::error_code ignored;
    return fs::is_regular_file(fs::path(folder) / kLinksFile, ignored);
}

RelightSummary relight_over_links(const std::string& folder, const std::string& states_path,
                                  Stages& stages)
{
    Baked baked = read(folder);
    const std::vector<NamedState> states = read_states(states_path);
    const ProgressCallback progress = stages.callback();
    SolveScene world(
        std::move(baked.scene),
        [&](const Scene& scene, const RayScene&, const ProgressCallback&) {
            return atlas_of(baked.links, scene, baked.record.pages);
        },
        {}, progress);
    SceneLights lights(world.scene, world.lumels);
    check_states(states, states_path, [&](const LightState& state) { lights.check(state); });
    OutputFolder output((fs::path(folder) / "states").string());

    stages.begin("states");
    KeptSolution solution(world, baked.record, baked.links, LinkRadiosity::Then::end);
    LinkRadiosity& light = solution.solver();
    RelightSummary summary;
    std::uint64_t traced = 0;
    for (std::size_t s = 0; s < states.size(); ++s) {
        const double part = 1.0 / double(states.size()), before = part * double(s);
        if (!stages.progress(before))
            break;
        const double start = wall_seconds();
        lights.set(states[s].light);
        world.surfaces = Surfaces(world.scene);  // with the emission of this state
        if (!unless_stopped([&] { solution.light(part_of(progress, before, before + part)); }))
            break;
        traced += light.traced();
        const double found = wall_seconds();
        const Image map = finish_map(world.scene, world.atlas, world.lumels, light.irradiance());
        write_map(output, states[s].name, map, baked.record.half, world, stages);
        summary.states.push_back({.name = states[s].name,
                                  .light = found - start,
                                  .files = wall_seconds() - found,
                                  .error = light.state().error,
                                  .dark_error = light.state().dark_error,
                                  .eye_error = light.state().eye_error});
    }
    stages.end();
    if (!summary.states.empty())
        output.commit();
    summary.seconds = stages.seconds();
    summary.interrupted = stages.stopped();
    summary.report = report_of(summary, traced, lights, baked);
    return summary;
}

}  // namespace lumel
