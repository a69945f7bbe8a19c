// The pipeline of lumel update.

#include "jobs/update/update.h"

#include <filesystem>
#include <optional>
#include <utility>

#include "base/json/json_file.h"
#include "jobs/bake/outputs.h"
#include "jobs/bake/report.h"
#include "jobs/edit/correction.h"
#include "jobs/edit/kept_solution.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/setting.h"
#include "jobs/update/update_report.h"
#include "links/kept/links_file.h"
#include "methods/matrix/matrix_file.h"
#include "methods/methods.h"
#include "results/files/folder.h"
#include "results/record/bake_record.h"
#include "results/record/light_settings.h"
#include "scene/values/origin.h"

namespace lumel {
namespace {

/// With a larger change of emission, relative to all emitted light, a new solution is faster than a
/// correction.
constexpr double kMaxChange = 0.25;

/// D' - D [N] [lx] in the edited scene.
std::vector<glm::vec3> change_of_lights(const gpu::Device& device, const EditedScene& edit,
                                        const BakeRecord& baked, Stages& stages)
{
    Scene as_before = edit.now.scene;
    as_before.lights = edit.before.scene.lights;
    as_before.profiles = edit.before.scene.profiles;
    as_before.sky = edit.before.scene.sky;
    stages.begin("sky and lamps");
    const auto light = [&](const Scene& scene) {
        if (!has_lights(scene))
            return std::vector<glm::vec3>(edit.now.lumels.lumels.size(), glm::vec3(0.0f));
        const World world(device, scene, edit.now.lumels, &edit.now.atlas);
        return direct_light(device, world, scene, edit.now.lumels,
                            {.sky_directions = baked.sky_directions,
                             .seed = seed_of(baked.solver.method),
                             .centre = rule_of(baked.solver.method) == SampleRule::centre},
                            [&](double fraction) {
                                stages.progress(fraction);
                                return true;
                            })
            .irradiance;
    };
    std::vector<glm::vec3> change = light(edit.now.scene);
    const std::vector<glm::vec3> former = light(as_before);
    for (std::size_t i = 0; i < change.size(); ++i)
        change[i] -= former[i];
    return change;
}

/// H' [N] [lx] by the bake's solver, in the edit's atlas.
std::vector<glm::vec3> solve_anew(const gpu::Device& device, const EditedScene& edit,
                                  BakeRecord& baked, UpdateRow& row, Stages& stages)
{
    BakeOptions options;
    options.sky_directions = baked.sky_directions;
    options.solver.method = baked.solver.method;
    // The ray tracing backend does not affect the result, and this can be another device.
    if (auto* links = std::get_if<LinksOptions>(&options.solver.method))
        links->rays = Rays::automatic;
    options.solver.target_error = baked.error > 0.0 ? baked.error : SolverOptions{}.target_error;
    if (baked.solver.target_quality.is_given()) {
        options.solver.target_error = baked.solver.target_error;
        options.solver.target_quality = baked.solver.target_quality;
        options.solver.max_shots = ray_limit(baked);
    }
    const Setting setting(
        edit.now.scene,
        [&](const Scene&, const RayScene&, const ProgressCallback&) { return edit.now.atlas; },
        &device, options, stages);
    std::unique_ptr<Solution> solution = solve_light(&device, setting, options, stages);
    const SolverState state = solution->solver->state();
    row.solved_anew = true;
    row.residual = state.error;
    baked.shots = state.shots;
    baked.iterations = state.iterations;
    return std::move(solution->irradiance);
}

/// H' [N] [lx], corrected if that is faster. device: created if needed.
std::vector<glm::vec3> light_after(const EditedScene& edit, const StoredSolution& solution,
                                   BakeRecord& baked, const UpdateOptions& options, UpdateRow& row,
                                   std::optional<gpu::Device>& device, Stages& stages)
{
    Correction correction(
        edit, solution, baked,
        {.begin = [&](const char* stage) { stages.begin(stage); },
         .follow = [&](double fraction,
                       std::uint64_t particles) { return stages.progress(fraction, particles); }});
    std::vector<glm::vec3> lights;
    if (row.relit)
        lights = change_of_lights(*device, edit, baked, stages);
    if (correction.change(lights) <= kMaxChange)
        if (auto irradiance = correction.correct(lights, options.residual, row))
            return std::move(*irradiance);
    if (!device)
        device.emplace(options.device);
    return solve_anew(*device, edit, baked, row, stages);
}

/// Light of the edited scene.
struct NewLight {
    std::vector<glm::vec3> irradiance;  ///< [N] [lx]
    std::vector<float> error;           ///< see Solver::error_estimate(); empty: not known
};

/// The links of a bake, if it stores any.
std::optional<StoredLinks> kept_links(const std::string& folder, const BakeRecord& baked)
{
    if (baked.keep_links == 0)
        return {};
    const std::string path = (std::filesystem::path(folder) / kLinksFile).string();
    StoredLinks kept = read_links(path);
    check_links(kept, baked, path);
    return kept;
}

/// As a bake with stored links computes it in the edited atlas. Updates the links.
NewLight light_over_links(const EditedScene& edit, StoredLinks& kept, BakeRecord& baked,
                          UpdateRow& row, Stages& stages)
{
    const StoredLinks mine = links_for(edit, std::exchange(kept, {}));
    stages.begin("solving");
    KeptSolution solution(edit.now, baked, mine, LinkRadiosity::Then::add);
    solution.light(stages.callback());
    LinkRadiosity& solver = solution.solver();
    const SolverState state = solver.state();
    row.rays = solver.traced();
    row.links = solver.sent();
    baked.shots = state.shots;
    baked.keep_links = std::uint32_t(state.shots);
    baked.iterations = state.iterations;
    baked.error = state.error;
    baked.dark_error = state.dark_error;
    baked.eye_error = state.eye_error;
    baked.visible_noise = state.visible_noise;
    kept = solver.kept(edit.now.scene.hash);
    return {solver.irradiance(), solver.error_estimate()};
}

void check_paths(const std::string& folder, const std::string& scene_path)
{
    namespace fs = std::filesystem;
    std::error_code ignored;
    if (fs::equivalent(fs::path(folder) / kSceneFile, scene_path, ignored))
        throw Error(ErrorKind::input, scene_path,
                    "is the bake's own file; save the edited scene elsewhere, and keep this one");
}

/// An update finds what has changed by the triangles of scene.glb.
void check_exact(const std::string& folder, const BakeRecord& baked)
{
    if (baked.compression == Compression::draco)
        throw Error(ErrorKind::input, folder,
                    "was baked with --compress draco, which rounds and reorders the triangles that "
                    "an update compares; bake the scene again, with --compress meshopt or none");
}

}  // namespace

UpdateSummary update(const std::string& folder, const std::string& scene_path,
                     const UpdateOptions& given, const ProgressFunction& progress)
{
    UpdateOptions options = given;
    Stages stages(progress);
    stages.begin("reading");
    std::optional<ResultsLock> as_it_is(folder);
    BakeRecord baked = read_bake_record(folder);
    check_correctable(folder, baked);
    check_exact(folder, baked);
    check_paths(folder, scene_path);
    check_light_files(baked.lights);
    if (light_settings(options.lights).empty())
        options.lights = baked.lights;
    const StoredSolution solution =
        read_solution((std::filesystem::path(folder) / kSolutionFile).string());
    Scene before = read_scene((std::filesystem::path(folder) / kSceneFile).string(),
                              MaterialModel::diffuse, baked.lights);
    Scene now = read_scene(scene_path, MaterialModel::diffuse, options.lights);
    set_origin(now, before.origin);
    std::optional<StoredLinks> kept = kept_links(folder, baked);
    OutputFolder output(folder);
    as_it_is.reset();

    stages.begin("charts");
    const EditedScene edit =
        kept ? EditedScene(std::move(before), std::move(now), solution, baked,
                           [&](const Scene& scene, const RayScene&, const ProgressCallback&) {
                               return atlas_of(*kept, scene, baked.pages);
                           })
             : EditedScene(std::move(before), std::move(now), solution, baked);
    UpdateRow row = changes_of(edit);
    row.error_before = baked.error;
    std::optional<gpu::Device> device;
    std::optional<WrittenLight> written;
    if (row.any()) {
        if ((row.relit && !kept) || options.preview_width > 0)
            device.emplace(options.device);
        const NewLight light =
            kept ? light_over_links(edit, *kept, baked, row, stages)
                 : NewLight{light_after(edit, solution, baked, options, row, device, stages), {}};
        stages.begin("finishing");
        const BakeOptions files{.parts = baked.parts,
                                .half = baked.half,
                                .keep_lights = baked.keep_lights,
                                .lightmap_format = baked.lightmap_format,
                                .compression = baked.compression,
                                .baked_size = baked.baked_size,
                                .preview_width = options.preview_width,
                                .exposure = baked.given_exposure};
        output.outdate(kMatrixFile);
        outdate_apart(output, folder);
        written = write_light(output, files, edit.now, device ? &*device : nullptr,
                              light.irradiance, light.error, {}, stages);
    }
    // A new solution has told of the scene.
    if (!row.solved_anew)
        tell_user(edit.now);
    if (kept) {
        kept->scene_hash = edit.now.scene.hash;
        write_links(output.path(kLinksFile), std::move(*kept));
    }
    if (written && !written->view)
        output.outdate(kPreview);
    output.outdate(kPageFile);
    output.outdate(kProbesFile);
    stages.end();
    if (device)
        device->check_validation();
    const BakeRecord record =
        corrected(std::move(baked), options, row, edit.now, written, stages.stopped());
    Report facts = update_report(record, row, edit.now, device ? &*device : nullptr, stages);
    if (written)
        facts.preview = preview_row(*written, edit.now.scene);
    const Json report = to_json(facts);
    write_json(output.path(kReportFile), report);
    output.commit();
    const bool is_solved = row.links > 0 || row.solved_anew;
    return {row,
            record.error,
            is_solved ? record.eye_error : -1.0,
            stages.seconds(),
            stages.stopped(),
            json_text(report)};
}

}  // namespace lumel
