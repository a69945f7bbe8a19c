#pragma once
// Direct light from emissive surfaces, by shadow rays, to a target error.

#include <memory>
#include <vector>

#include "links/direct/direct.h"
#include "solve/solver/solver.h"

namespace lumel {

struct HostScene;

/// Direct light from the scene's emissive surfaces, without sky and lamps. Lumels at shadow edges
/// store it per cell. Uses Embree.
class DirectRays {
public:
    /// All arguments must outlive this. known: [N] [lx] irradiance that is added to the light when
    /// the error is made relative, or empty.
    DirectRays(const HostScene& host, const Lumels& lumels, std::uint32_t seed, double target_error,
               std::span<const glm::vec3> known = {});

    /// Works for a fraction of a second. Continues beyond target_error while rays help.
    void step();
    /// `shots` are rays per lumel, on average.
    SolverState state() const { return state_; }
    std::vector<glm::vec3> irradiance() const;  ///< H [N] [lx]

    // For callers that trace more rays.
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
