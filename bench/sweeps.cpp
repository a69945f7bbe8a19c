// How fast the host and the device sweep over links.

#include <algorithm>
#include <limits>

#include <fmt/core.h>

#include "atlas/cells/order.h"
#include "base/core/error.h"
#include "bench/modes.h"
#include "bench/stopwatch.h"
#include "links/rays/tracer.h"
#include "links/sweeps/sweeps.h"
#include "rays/cast/ray_caster.h"

namespace lumel::bench {
namespace {

/// Rays per lumel, as one solution of a bake has them.
constexpr std::uint16_t kRays = 32;
constexpr double kResidual = 1e-3;
/// Runs of each, of which the fastest counts.
constexpr int kTimes = 3;

/// One solution's links of a scene, traced by the CPU.
struct Traced {
    explicit Traced(const SolveScene& world)
        : work(world, {cast_on_host(world.rays)}, SampleRule::area, order_in_space),
          parts(work.world, work.cells, world.rays, world.lumels, work.order, kPartStream),
          direct(work, kDirectStream),
          numbers(world.scene.instances.size(), parts.count()),
          tracer(work, parts, numbers, direct, 1),
          links(parts.count())
    {
        while (direct.step()) {
        }
        links.rounds.emplace_back(tracer.blocks());
        const std::vector<std::uint16_t> rays(work.order.size(), kRays);
        tracer.trace(0, tracer.blocks(), {rays, kLinkStream, nullptr, nullptr}, links);
        source = find_source_term(work, parts, numbers, {work, parts, numbers, direct}, links);
    }

    LinkWork work;
    SubLumels parts;
    DirectEstimator direct;
    LinkNumbers numbers;
    LinkTracer tracer;
    LinkTable links;
    SourceTerm source;
};

void print(const char* name, double milliseconds, int sweeps)
{
    fmt::print("{:<28} {:>10.3f} {:>10.2f}\n", name, milliseconds / sweeps, milliseconds);
}

}  // namespace

void time_sweeps(const gpu::Device& device, const SolveScene& world)
{
    const Traced traced(world);
    const LinkSolver solver(traced.work, traced.parts, traced.numbers);
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
