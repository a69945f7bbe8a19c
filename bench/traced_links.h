#pragma once
// Links of a scene traced round by round, for timings and tests of sweeps.

#include <cstdint>
#include <vector>

#include "atlas/cells/order.h"
#include "links/rays/tracer.h"
#include "links/sweeps/sweeps.h"
#include "rays/cast/ray_caster.h"

namespace lumel::bench {

/// One solution's links and source term, by the CPU.
struct TracedLinks {
    /// scene: must outlive this.
    explicit TracedLinks(const SolveScene& scene)
        : work(scene, {cast_on_host(scene.rays)}, SampleRule::area, order_in_space),
          parts(work.world, work.cells, scene.rays, scene.lumels, work.order, kPartStream),
          direct(work, kDirectStream),
          numbers(scene.scene.instances.size(), parts.count()),
          tracer(work, parts, numbers, direct, 1),
          solver(work, parts, numbers),
          links(parts.count())
    {
        while (direct.step()) {
        }
    }

    /// Adds a round of links with other random numbers.
    void trace(std::uint16_t rays, const RayGuide* guide = nullptr)
    {
        links.rounds.emplace_back(tracer.blocks());
        const std::vector<std::uint16_t> each(work.order.size(), rays);
        LinkTracer::Sending sending{each, kLinkStream + ++streams, nullptr, guide};
        tracer.trace(0, tracer.blocks(), sending, links);
        source = find_source_term(work, parts, numbers, {work, parts, numbers, direct}, links);
    }

    LinkWork work;
    SubLumels parts;
    DirectEstimator direct;
    LinkNumbers numbers;
    LinkTracer tracer;
    LinkSolver solver;
    LinkTable links;
    SourceTerm source;
    std::uint32_t streams = 0;  ///< of random numbers, so far
};

}  // namespace lumel::bench
