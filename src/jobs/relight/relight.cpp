#include "jobs/relight/relight.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include "atlas/finish/finish.h"
#include "base/core/usage.h"
#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "jobs/edit/solution_file.h"
#include "jobs/relight/relight_links.h"
#include "jobs/relight/states_file.h"
#include "jobs/solve/stages.h"
#include "links/kept/links_file.h"
#include "methods/matrix/matrix_file.h"
#include "methods/matrix/relight_session.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"
#include "results/record/origin.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// States that are lit together.
constexpr std::size_t kStatesAtOnce = 16;
/// Maximum fraction of lumels that differ in scene.glb, whose texture coordinates are rounded: they
/// are at the borders of charts.
constexpr double kMaxStrangers = 0.01;

/// The matrix of a folder; throws if it is not of the bake there.
Relightable read_matrix(const std::string& folder, const BakeRecord& baked,
                        const StoredSolution& solution)
{
    const std::string path = (fs::path(folder) / kMatrixFile).string();
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored))
        throw Error(ErrorKind::input, folder,
                    std::string("has neither ") + kLinksFile + " nor " + kMatrixFile +
                        "; bake the scene with --keep-links or --solver matrix to relight it");
    Relightable light = read_relightable(path);
    if (light.scene_hash != baked.scene_hash || int(light.side) != solution.side)
        throw Error(ErrorKind::input, path,
                    "belongs to another scene or atlas than the bake in this folder; bake the "
                    "scene with --solver matrix again");
    return light;
}

SolveScene read_world(const std::string& folder, const BakeRecord& baked,
                      const StoredSolution& solution)
{
    Scene scene = read_scene((fs::path(folder) / kSceneFile).string(), MaterialModel::diffuse, {});
    scene.hash = baked.scene_hash;  // its vertices are split, its light is the same
    return SolveScene(
        std::move(scene), [&](const Scene& read, const RayScene&, const ProgressCallback&) {
            return written_atlas(read, baked.pages, float(baked.texels_per_metre), solution.charts);
        });
}

/// [N of the world] Index of each lumel in the matrix, or kNoLumel.
std::vector<std::uint32_t> numbers_in(const Relightable& light, const Lumels& lumels,
                                      const std::string& folder)
{
    std::vector<std::uint32_t> at(2 * std::size_t(light.side) * light.side, kNoLumel);
    for (std::uint32_t i = 0; i < light.size(); ++i)
        at[light.place[i]] = i;
    std::vector<std::uint32_t> numbers;
    std::size_t strangers = 0;
    for (const Lumel& lumel : lumels.lumels) {
        numbers.push_back(at[place_of(lumel.texel, (lumel.flags & kLumelBack) != 0)]);
        strangers += numbers.back() == kNoLumel;
    }
    if (double(strangers) > kMaxStrangers * double(numbers.size()))
        throw Error(ErrorKind::input, (fs::path(folder) / kMatrixFile).string(),
                    "was made for another atlas; bake the scene with --solver matrix again");
    return numbers;
}

std::vector<glm::vec3> in_order(std::span<const glm::vec3> light,
                                const std::vector<std::uint32_t>& numbers)
{
    std::vector<glm::vec3> result;
    result.reserve(numbers.size());
    for (const std::uint32_t number : numbers)
        result.push_back(number == kNoLumel ? glm::vec3(0.0f) : light[number]);
    return result;
}

std::string report_of(const RelightSummary& summary, const RelightSession& session,
                      const gpu::Device& device)
{
    Json json;
    json["lumel"] = lumel_version();
    json["device"] = device.info().name;
    json["matrix"] = {{"scene_hash", session.light().scene_hash},
                      {"lumels", session.size()},
                      {"patches", session.light().patches.size()},
                      {"bytes", bytes_of(session.light().matrix)},
                      {"sources", session.names()}};
    json["seconds"] = summary.seconds;
    json["states"] = json_of(summary.states);
    return json_text(json);
}

}  // namespace

Json json_of(const std::vector<StateRow>& states)
{
    Json json = Json::array();
    for (const StateRow& row : states) {
        Json& state = json.emplace_back(Json{{"name", row.name},
                                             {"light_seconds", row.light},
                                             {"files_seconds", row.files},
                                             {"files", {row.name + ".exr", row.name + ".png"}}});
        if (row.error >= 0.0)
            state["estimated_error"] = row.error;
        if (row.dark_error >= 0.0)
            state["estimated_dark_error"] = row.dark_error;
        if (row.eye_error >= 0.0)
            state["estimated_eye_error"] = row.eye_error;
    }
    return json;
}

RelightSummary relight(const std::string& folder, const std::string& states_path,
                       const RelightOptions& options, const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    std::optional<ResultsLock> as_it_is(folder);
    if (keeps_links(folder)) {
        as_it_is.reset();
        return relight_over_links(folder, states_path, stages);
    }
    const BakeRecord baked = read_bake_record(folder);
    const StoredSolution solution = read_solution((fs::path(folder) / kSolutionFile).string());
    Relightable light = read_matrix(folder, baked, solution);
    const std::vector<NamedState> states = read_states(states_path);
    const SolveScene world = read_world(folder, baked, solution);
    as_it_is.reset();
    const std::vector<std::uint32_t> numbers = numbers_in(light, world.lumels, folder);
    const gpu::Device device(options.device);
    stages.watch(device);
    RelightSession session(device, std::move(light));
    std::optional<World> lit;
    if (std::any_of(states.begin(), states.end(),
                    [](const NamedState& state) { return !state.light.places.empty(); })) {
        lit.emplace(device, world.scene, world.lumels, &world.atlas);
        session.set_world({*lit, world.lumels, numbers, {}});
    }
    check_states(states, states_path, [&](const LightState& state) { session.check(state); });
    OutputFolder output((fs::path(folder) / "states").string());

    stages.begin("states");
    RelightSummary summary;
    for (std::size_t first = 0; first < states.size() && !stages.stopped();
         first += kStatesAtOnce) {
        const std::size_t count = std::min(kStatesAtOnce, states.size() - first);
        std::vector<LightState> some;
        for (std::size_t i = first; i < first + count; ++i)
            some.push_back(states[i].light);
        const double start = wall_seconds();
        const std::vector<std::vector<glm::vec3>> maps = session.irradiance(some);
        const double each = (wall_seconds() - start) / double(count);
        for (std::size_t i = 0; i < count; ++i) {
            if (!stages.progress(double(first + i) / double(states.size())))
                break;
            const double begin = wall_seconds();
            const Image map =
                finish_map(world.scene, world.atlas, world.lumels, in_order(maps[i], numbers));
            write_map(output, states[first + i].name, map, baked.half, world, stages);
            summary.states.push_back({states[first + i].name, each, wall_seconds() - begin});
        }
    }
    stages.end();
    device.check_validation();
    output.commit();
    summary.seconds = stages.seconds();
    summary.interrupted = stages.stopped();
    summary.report = report_of(summary, session, device);
    return summary;
}

}  // namespace lumel
