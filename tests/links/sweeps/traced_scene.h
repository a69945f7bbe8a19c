#pragma once
// Scenes whose links are traced round by round, for tests of sweeps.

#include <utility>

#include "../../../bench/traced_links.h"

namespace lumel::support {

struct OwnScene {
    SolveScene scene;
};

struct TracedScene : OwnScene, bench::TracedLinks {
    /// of: arguments of SolveScene.
    template <class... Arguments>
    explicit TracedScene(Arguments&&... of)
        : OwnScene{SolveScene(std::forward<Arguments>(of)...)},
          TracedLinks(scene)
    {
    }

    /// A guide by which every other bin gets a third of the rays of its neighbours.
    RayGuide striped_guide() const
    {
        RayGuide guide{std::vector<std::uint32_t>(work.order.size(), 1),
                       {RayGuide::all_uniform(), RayGuide::all_uniform()}};
        for (RayGuide::OfSolution& of : guide.tables[1])
            for (std::uint32_t b = 0; b < RayGuide::kBins; ++b)
                of.probabilities[b] = std::uint16_t(b % 2 == 0 ? 128 : 384);
        return guide;
    }
};

}  // namespace lumel::support
