#include "bake/setting.h"

#include <algorithm>
#include <cmath>

#include "core/log.h"
#include "solve/methods.h"

namespace lumel {
namespace {

/// The progress of a solve toward the limit that is nearest, 0…1.
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

Scene in_stage(Scene scene, Stages& stages)
{
    stages.begin("charts");
    return scene;
}

NearField near_field_of(const Prepared& world, const SolverOptions& options, Stages& stages)
{
    tell_user(world);
    stages.begin("near field");
    return near_field_for(world.scene, world.rays, world.lumels, options);
}

const gpu::Device& upload_to(const gpu::Device& device, Stages& stages)
{
    stages.begin("uploading");
    return device;
}

}  // namespace

std::optional<LobeParticles> particles_for(const Prepared& world, const SolverOptions& options)
{
    std::optional<LobeParticles> particles;
    if (method_of(options.method).materials == MaterialModel::glossy && !is_papers(options.method))
        particles.emplace(world.scene, world.atlas, world.rays, world.lumels);
    return particles;
}

Setting::Setting(Scene scene, const gpu::Device& device, const BakeOptions& options, Stages& stages)
    : Setting(
          std::move(scene), [&](const Scene& placed) { return make_atlas(placed, options.atlas); },
          device, options, stages)
{
}

Setting::Setting(Scene scene, const Prepared::LayOut& lay_out, const gpu::Device& device,
                 const BakeOptions& options, Stages& stages)
    : world(in_stage(std::move(scene), stages), lay_out),
      near(near_field_of(world, options.solver, stages)),
      resident(upload_to(device, stages), world.scene, world.lumels, &world.atlas),
      particles(particles_for(world, options.solver))
{
}

SolveRun solve_in_stage(Solver& solver, const SolverOptions& options, Stages& stages)
{
    stages.begin("solving");
    SolveRun run;
    run.finished = solve(solver, options, [&](const SolverState& state) {
        const double seconds = stages.stage_seconds();
        if (state.error >= 0.0 && (run.curve.empty() || run.curve.back().error != state.error))
            run.curve.push_back({state.shots, seconds, state.error});
        return stages.tell(solved_fraction(options, state, seconds), state.shots, state.error);
    });
    return run;
}

void tell_warnings(const Scene& scene)
{
    for (const std::string& warning : scene.warnings)
        log_warning(warning);
}

void tell_user(const Prepared& world)
{
    tell_warnings(world.scene);
    for (const std::string& note : world.atlas.notes)
        log_info(note);
}

}  // namespace lumel
