#pragma once
// Direct light from emissive surfaces, by shadow rays, to a target error.

#include <memory>
#include <vector>

#include "links/direct/direct.h"
#include "solve/solver/solver.h"

namespace lumel {

/// Direct light from the scene's emissive surfaces, without sky and lamps. Lumels at shadow edges
/// store it per cell. Uses Embree.
class DirectRays {
public:
    /// The scene must outlive this. known: [N] [lx] irradiance that is added to the light when the
    /// error is made relative, or empty. instances: emissive ones that count; empty: all.
    DirectRays(const SolveScene& scene, std::uint32_t seed, double target_error,
               std::span<const glm::vec3> known = {},
               const std::vector<std::uint32_t>& instances = {});

    /// Works for a fraction of a second. Continues beyond target_error while rays help.
    void step();
    /// `shots` are rays per lumel, on average.
    SolverState state() const { return state_; }
    std::vector<glm::vec3> irradiance() const;  ///< H [N] [lx]

    // For callers that trace more rays.
    const LinkWork& work() const { return work_; }
    const DirectEstimator& finder() const { return finder_; }

private:
    void estimate();

    double target_error_;
    double known_ = 0.0;  ///< Σ over lumels and channels [lx]
    LinkWork work_;
    DirectEstimator finder_;
    SolverState state_;
};

}  // namespace lumel
