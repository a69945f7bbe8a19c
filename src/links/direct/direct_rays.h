#pragma once
// Direct light of surfaces that shine, by rays to points on them, as exact as is asked for.

#include <memory>
#include <vector>

#include "links/direct/direct.h"
#include "solve/solver/solver.h"

namespace lumel {

struct HostScene;

/// Light straight from the scene's emissive surfaces; sky and lamps are left out. Lumels that hold
/// a shadow's edge have it per cell. Rays go through Embree.
class DirectRays {
public:
    /// What is given must outlive it. known: [N] [lx] of other light that the stated error is
    /// relative to, or empty.
    DirectRays(const HostScene& host, const Lumels& lumels, std::uint32_t seed, double target_error,
               std::span<const glm::vec3> known = {});

    /// A part of a second of work. Goes on beyond target_error, as long as rays help.
    void step();
    /// Rays of a lumel in the mean count as shots.
    SolverState state() const { return state_; }
    std::vector<glm::vec3> irradiance() const;  ///< H [N] [lx]

    // For those who trace more rays.
    const LinkScene& place() const { return place_; }
    const WorldLumels& world() const { return world_; }
    const Cells& cells() const { return cells_; }
    const RayOrigins& starts() const { return starts_; }
    const LightSources& sources() const { return sources_; }
    const std::vector<std::uint32_t>& order() const { return order_; }
    const DirectEstimator& finder() const { return finder_; }

private:
    void estimate();

    double target_error_;
    double known_ = 0.0;  ///< Σ over lumels and channels [lx]
    Scene dark_;          ///< without sky and lamps
    Surfaces surfaces_;
    std::unique_ptr<RayCaster> caster_;
    LinkScene place_;
    WorldLumels world_;
    Cells cells_;
    RayOrigins starts_;
    LightSources sources_;
    std::vector<std::uint32_t> order_;  ///< [N]
    DirectEstimator finder_;
    SolverState state_;
};

}  // namespace lumel
