// The score: the whole of Lumel, in order.

#include "bake/bake.h"

#include <algorithm>
#include <cmath>

#include "bake/outputs.h"
#include "bake/prepare.h"
#include "bake/stages.h"
#include "core/log.h"
#include "output/folder.h"
#include "solve/solver.h"

namespace lumel {
namespace {

/// How far a solve is on the way to whichever limit is nearest, 0…1.
double solved_fraction(const SolverOptions& limits, const SolverState& state, double seconds)
{
    double fraction = 0.0;
    if (limits.max_shots > 0)
        fraction = std::max(fraction, double(state.shots) / double(limits.max_shots));
    if (limits.max_seconds > 0.0)
        fraction = std::max(fraction, seconds / limits.max_seconds);
    if (limits.target_error > 0.0 && state.error > 0.0) {
        // For the bar only: how fast the error falls with shots, between random and ideal.
        constexpr double kSlope = 0.65;
        fraction = std::max(fraction, std::pow(limits.target_error / state.error, 1.0 / kSlope));
    }
    return std::min(fraction, 1.0);
}

void tell_user(const Prepared& world)
{
    for (const std::string& warning : world.scene.warnings)
        log_warning(warning);
    for (const std::string& note : world.atlas.notes)
        log_info(note);
}

}  // namespace

BakeSummary bake(const std::string& scene_path, const std::string& folder,
                 const BakeOptions& options, const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    Scene scene = read_gltf(scene_path, method_of(options.solver.method).materials);
    // What can fail before the long work should.
    OutputFolder output(folder);
    const gpu::Device device(options.device);

    stages.begin("charts");
    const Prepared world(std::move(scene), options.atlas);
    tell_user(world);

    stages.begin("near field");
    NearField near;
    if (options.solver.scheme == Scheme::phased)
        near = build_near_field(world.scene, world.rays, world.lumels,
                                near_field_options(options.solver));

    stages.begin("uploading");
    const World resident(device, world.scene, world.lumels);
    const std::unique_ptr<Solver> solver =
        make_solver(device, resident, world.lumels, near, options.solver);

    stages.begin("solving");
    std::vector<ConvergencePoint> curve;
    const bool finished = solve(*solver, options.solver, [&](const SolverState& state) {
        const double seconds = stages.stage_seconds();
        if (state.error >= 0.0 && (curve.empty() || curve.back().error != state.error))
            curve.push_back({state.shots, seconds, state.error});
        return stages.tell(solved_fraction(options.solver, state, seconds), state.shots,
                           state.error);
    });
    const std::vector<glm::vec3> irradiance = solver->irradiance();

    stages.begin("finishing");
    Results results{.shots = solver->state().shots,
                    .iterations = solver->state().iterations,
                    .error = solver->state().error,
                    .interrupted = !finished,
                    .near_pairs = near.column.size(),
                    .curve = std::move(curve)};
    return write_bake(output, options, world, device, *solver, irradiance, results, stages);
}

BakeSummary bake_reference(const std::string& scene_path, const std::string& folder,
                           const BakeOptions& options, const ReferenceOptions& reference,
                           MaterialModel materials, const ProgressFunction& progress)
{
    Stages stages(progress);
    stages.begin("reading");
    Scene scene = read_gltf(scene_path, materials);
    OutputFolder output(folder);
    stages.begin("charts");
    const Prepared world(std::move(scene), options.atlas);
    tell_user(world);

    stages.begin("path tracing");
    bool stopped = false;
    const std::vector<glm::vec3> irradiance = reference_irradiance(
        world.scene, world.rays, world.lumels, reference, [&](double fraction) {
            stopped = !stages.tell(fraction, std::uint64_t(fraction * reference.samples_per_lumel));
            return !stopped;
        });

    stages.begin("finishing");
    return write_reference(output, options, reference, world, irradiance, stopped, stages);
}

}  // namespace lumel
