// How the cost of shooting grows with the atlas. The near field and all set-up are left out: they
// are paid once.

#include "bench/modes.h"

#include <algorithm>

#include <fmt/core.h>

#include "bench/stopwatch.h"
#include "solve/solver/solver.h"

namespace lumel::bench {
namespace {

/// Shooters that are timed, three times over, after as many to warm up.
constexpr std::uint64_t kTimedShots = 256;
constexpr int kRounds = 3;

void shoot(Solver& solver, std::uint64_t shots)
{
    const std::uint64_t until = solver.state().shots + shots;
    while (solver.state().shots < until)
        solver.step();
    solver.irradiance();  // waits
}

}  // namespace

void grow(const Settings& settings)
{
    const gpu::Device device(settings.device);
    fmt::print("{}, device: {} ({})\n", settings.scene, device.info().name, device.info().driver);
    fmt::print("{:>6} {:>9} {:>16} {:>18} {:>22}\n", "atlas", "lumels", "wall ms/shooter",
               "cpu ms/shooter", "cpu ns/shooter/lumel");
    for (const int size : settings.growth) {
        const SolveScene world = prepare(settings, size);
        const World gpu_world(device, world.scene, world.lumels);
        const NearField none{.first = std::vector<std::uint32_t>(world.lumels.lumels.size() + 1)};
        const auto solver = make_solver({.device = &device,
                                         .world = &gpu_world,
                                         .lumels = world.lumels,
                                         .near = none,
                                         .scene = &world},
                                        solver_of(settings));
        shoot(*solver, kTimedShots);
        double cpu = 1e30, wall = 1e30;
        for (int round = 0; round < kRounds; ++round) {
            Stopwatch watch;
            watch.start();
            shoot(*solver, kTimedShots);
            watch.stop();
            cpu = std::min(cpu, watch.cpu);
            wall = std::min(wall, watch.wall);
        }
        const double per_shot = 1.0 / double(kTimedShots);
        fmt::print("{:>6} {:>9} {:>16.3f} {:>18.3f} {:>22.1f}\n", size, world.lumels.lumels.size(),
                   1e3 * wall * per_shot, 1e3 * cpu * per_shot,
                   1e9 * cpu * per_shot / double(world.lumels.lumels.size()));
        std::fflush(stdout);
    }
}

}  // namespace lumel::bench
