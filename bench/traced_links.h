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

    /// Adds a round of links with other random numbers. guide: the same in all rounds after the
    /// first.
    void trace(std::uint16_t rays, const RayGuide* guide = nullptr)
    {
        links.rounds.emplace_back(tracer.blocks());
        const std::vector<std::uint16_t> each(work.order.size(), rays);
        const auto round = std::uint32_t(links.rounds.size() - 1);
        // A guide may follow the first round, whose rays are uniform.
        const RayGuide none;
        const RayGuide* const keeps_bins = round == 0 && !guide ? &none : guide;
        tracer.trace(0, tracer.blocks(), {each, round, 0, nullptr, keeps_bins}, links);
        if (guide)
            tracer.weigh(*guide, 0, links);
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
};

}  // namespace lumel::bench
