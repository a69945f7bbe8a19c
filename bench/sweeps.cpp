// How fast the host and the device sweep over links.

#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "base/core/error.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"
#include "bench/traced_links.h"

namespace lumel::bench {
namespace {

/// Rays per lumel, as one solution of a bake has them.
constexpr std::uint16_t kRays = 32;
constexpr double kResidual = 1e-3;
/// Runs of each, of which the fastest counts.
constexpr int kTimes = 3;

void print(const char* name, double milliseconds, int sweeps)
{
    fmt::print("{:<28} {:>10.3f} {:>10.2f}\n", name, milliseconds / sweeps, milliseconds);
}

}  // namespace

void time_sweeps(const gpu::Device& device, const SolveScene& world)
{
    TracedLinks traced(world);
    traced.trace(kRays);
    const LinkSolver& solver = traced.solver;
    LinkSolver::Swept host{}, found{};
    std::vector<glm::vec3> received, by_device;
    const double on_host = 1e3 * fastest(kTimes, [&] {
                               received.clear();
                               host =
                                   solver.solve(traced.links, traced.source, kResidual, received);
                           });
    DeviceSweeps sweeps(device, solver.albedo());
    DeviceLinks copy;
    const double copying =
        1e3 * fastest(kTimes, [&] {
            copy = {};
            copy.update(device, {traced.work, traced.parts, traced.numbers}, traced.links);
        });
    double kernels = std::numeric_limits<double>::infinity();
    const double on_device = 1e3 * fastest(kTimes, [&] {
                                 by_device.clear();
                                 const gpu::StageTimes before = sweeps.times();
                                 found = solver.solve_on(sweeps, copy, traced.links, traced.source,
                                                         kResidual, by_device);
                                 double sum = 0.0;
                                 for (const auto& [kind, ms] : sweeps.times())
                                     sum += ms - (before.contains(kind) ? before.at(kind) : 0.0);
                                 kernels = std::min(kernels, sum);
                             });
    fmt::print("\n{:<28} {:>10} {:>10}  {} sub-lumels, {} rays each, {} sweeps\n",
               "sweeps over links [ms]", "each", "all", traced.parts.count(), kRays, host.sweeps);
    print("host", on_host, host.sweeps);
    print("device", on_device, found.sweeps);
    print("device, kernels alone", kernels, found.sweeps);
    fmt::print("{:<28} {:>10} {:>10.2f}  {:.1f} MB\n", "copying links to it", "", copying,
               1e-6 * double(copy.bytes()));
    if (received != by_device)
        throw Error(ErrorKind::device, device.info().name, "gives another light than the CPU");
    fmt::print("the same light\n");
}

}  // namespace lumel::bench
