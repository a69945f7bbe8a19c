#include "bench/papers/our_default.h"

#include <fmt/format.h>

#include "atlas/finish/finish.h"
#include "bench/stopwatch.h"
#include "jobs/solve/setting.h"
#include "methods/methods.h"
#include "solve/solver/solver.h"

namespace lumel::bench {

Solved solve_by(const gpu::Device& device, const SolveScene& world, const SolverOptions& options)
{
    Stopwatch watch;
    watch.start();
    const NearField near = near_field_for(world.scene, world.rays, world.lumels, options);
    const World resident(device, world.scene, world.lumels, &world.atlas);
    const std::optional<LobeParticles> particles = particles_for(world, options);
    const auto solver = make_solver({.device = &device,
                                     .world = &resident,
                                     .lumels = world.lumels,
                                     .near = near,
                                     .particles = particles ? &*particles : nullptr,
                                     .scene = &world},
                                    options);
    solve(*solver, options);
    Solved solved{.irradiance = solver->irradiance()};
    watch.stop();
    solved.cpu = watch.cpu;
    solved.wall = watch.wall;
    return solved;
}

Solved solve_by_default(const gpu::Device& device, const SolveScene& world)
{
    SolverOptions options;
    if (world.scene.model == MaterialModel::glossy)
        options.method = GlossyOptions{};
    set_default_limits(options);
    return solve_by(device, world, options);
}

Image map_of(const SolveScene& world, const Solved& solved)
{
    return finish_map(world.scene, world.atlas, world.lumels, solved.irradiance);
}

Cell words_of(double relative_rmse, double cpu)
{
    return {fmt::format("{:.2f} %, {:.2f} s", 100.0 * relative_rmse, cpu), 100.0 * relative_rmse};
}

}  // namespace lumel::bench
