// The bake pipeline.

#include "jobs/bake/bake.h"

#include <algorithm>
#include <optional>

#include "jobs/bake/advice.h"
#include "jobs/bake/daylight_files.h"
#include "jobs/bake/outputs.h"
#include "jobs/bake/shared_bake.h"
#include "jobs/edit/kept_solution.h"
#include "jobs/inspect/probes.h"
#include "jobs/solve/checkpoint.h"
#include "jobs/solve/dump.h"
#include "jobs/solve/lighting.h"
#include "jobs/solve/memory_plan.h"
#include "jobs/solve/sources.h"
#include "links/kept/links_file.h"
#include "methods/matrix/matrix_file.h"
#include "methods/methods.h"
#include "raster/shadow_maps/direct_light.h"
#include "results/files/folder.h"
#include "solve/solver/solver.h"

namespace lumel {
namespace {

/// Bakes everything except light probes. output: created once the scene is read, by the first rank.
BakeSummary bake_light(const std::string& scene_path, const std::string& folder,
                       BakeOptions options, std::optional<OutputFolder>& output,
                       const ProgressFunction& progress, Ranks* ranks)
{
    const bool writes = !ranks || ranks->is_first();
    options.atlas = atlas_that_fits(options);
    options.ranks = ranks ? ranks->count() : 1;
    const MethodInfo& method = method_of(options.solver.method);
    check_parts(options);
    check_keep_links(options);
    check_resume(options);
    open_libraries(options);
    Stages stages(progress);
    stages.begin("reading");
    if (ranks)
        check_ranks(*ranks, options, stages);
    const std::optional<WantedDaylight> wanted = wanted_daylight(options, stages);
    Scene scene = read_scene(scene_path, method.materials, options.lights);
    // Checks for failures before the long work.
    if (writes)
        output.emplace(folder);
    if (ranks)
        check_folder(*ranks, folder, output);
    std::optional<OutputFolder> dump;
    if (writes && !options.dump.empty())
        dump.emplace(options.dump, "dump");
    const gpu::Device device(options.device);

    const MemoryLimits limits = memory_limits(options, &device);
    check_memory(scene, options, limits);
    const Setting setting(std::move(scene), &device, options, stages, ranks);
    if (options.probe_spacing > 0.0)
        check_probe_spacing(options.probe_spacing, setting.prepared);
    if (wanted)
        wanted->check_memory(setting.prepared, options, limits.host);
    limit_links(options, setting.prepared, limits);
    if (ranks)
        agree_on_limits(*ranks, options);
    Checkpoint checkpoint(folder, options, setting.prepared, writes);
    const std::unique_ptr<Solution> solution =
        keeps_sources_apart(options)
            ? solve_sources(device, setting, options, stages)
            : solve_light(&device, setting, options, stages, &checkpoint, ranks);
    if (ranks && gathers_links(options))
        dynamic_cast<LinkRadiosity&>(*solution->solver).gather_links();
    const std::vector<RankCost> costs = ranks ? ranks->costs() : std::vector<RankCost>();
    if (!writes)
        return {};
    const SolverState solved = solution->solver->state();
    SolveRun& run = solution->run;
    if (dump) {
        stages.begin("dumping");
        write_dump(*dump, device, setting, solution->irradiance, options.solver);
    }

    DirectionalLight directional;
    if (options.directional != Directional::none) {
        stages.begin("directional light");
        directional = gather_directional(
            device, *setting.world, setting.prepared.scene, setting.prepared.rays,
            setting.prepared.lumels, setting.near, solution->irradiance,
            directional_options(options, solved.shots),
            [&](double fraction) { return run.finished && stages.progress(fraction); });
    }

    const std::optional<LampLights> per_lamp = keep_lamps_apart(*solution->solver, stages);
    if (!per_lamp && keeps_lamps_apart(options))
        stages.tell("the bake was stopped before the maps of lamps were made; --resume makes them");

    std::optional<DaylightMaps> daylight;
    if (wanted)
        daylight = make_daylight_maps(*wanted, setting.prepared, options.atlas,
                                      std::uint32_t(seed_of(options.solver.method)), stages);

    const bool stopped = stages.stopped();
    // Without light there is no error.
    const bool lit = is_lit(solution->irradiance);
    stages.begin("finishing");
    tell_advice(setting.prepared, options, *solution, stages);
    const Results results{.shots = solved.shots,
                          .iterations = solved.iterations,
                          .error = lit ? solved.error : -1.0,
                          .dark_error = lit ? solved.dark_error : -1.0,
                          .eye_error = lit ? solved.eye_error : -1.0,
                          .visible_noise = lit ? solved.visible_noise : VisibleNoise(),
                          .interrupted = stopped,
                          .near_pairs = setting.near.column.size(),
                          .curve = std::move(run.curve),
                          .relightable = solution->relightable.has_value(),
                          .form_factors = solution->form_factors,
                          .lamps = std::move(solution->lamps),
                          .directional = std::move(directional),
                          .per_lamp = per_lamp,
                          .ranks = costs};
    output->outdate(kMatrixFile);
    output->outdate(kLinksFile);
    outdate_apart(*output, folder);
    if (!stopped)
        output->outdate(kCheckpointFile);
    if (solution->relightable)
        write_relightable(output->path(kMatrixFile), *solution->relightable);
    if (options.keep_links)
        write_links(output->path(kLinksFile), dynamic_cast<const LinkRadiosity&>(*solution->solver)
                                                  .kept(setting.prepared.scene.hash));
    std::vector<std::string> more_files;
    if (daylight)
        more_files = write_daylight(*output, options, setting.prepared, *wanted, *daylight,
                                    solution->irradiance, stages);
    return write_bake(*output, options, setting.prepared, device, *solution->solver,
                      solution->irradiance, results, more_files, stages);
}

}  // namespace

void check_parts(const BakeOptions& options)
{
    if (options.parts == Parts::all)
        return;
    if (options.probe_spacing > 0.0)
        throw Error(ErrorKind::input, "--probes with --only",
                    "is not possible: light probes hold all light, direct and indirect");
    if (options.directional != Directional::none)
        throw Error(ErrorKind::input, "--directional with --only",
                    "is not possible: directional layers hold all light, direct and indirect");
    if (!options.daylight.empty())
        throw Error(ErrorKind::input, "--daylight with --only",
                    "is not possible: maps of daylight hold all light but direct sun");
}

BakeSummary bake(const std::string& scene_path, const std::string& folder,
                 const BakeOptions& options, const ProgressFunction& progress, Ranks* ranks)
{
    std::optional<OutputFolder> output;
    BakeSummary summary = bake_light(scene_path, folder, options, output, progress, ranks);
    if (!output)
        return summary;
    // A complete map is kept even if its probes are stopped.
    if (options.probe_spacing > 0.0 && !summary.interrupted)
        summary.interrupted =
            !unless_stopped([&] { add_probes(*output, options.probe_spacing, progress); });
    output->commit();
    return summary;
}

}  // namespace lumel
