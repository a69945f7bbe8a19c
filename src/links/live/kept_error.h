#pragma once
// Error estimate of light over stored links, from subsets of their rays.

#include <span>
#include <vector>

#include "base/core/progress_callback.h"
#include "links/live/display_filter.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

/// Relative, as SolverState::error and dark_error; < 0: there is no light.
struct KeptError {
    double all = -1.0, dark = -1.0;
};

/// Converged light over the links of a scene.
struct LightAtRest {
    const LumelLinks& links;
    const LumelSweeps& sweeps;
    std::span<const Lumel> lumels;          ///< [N]
    std::span<const glm::vec3> lamps;       ///< [N] [lx] direct light, without that of the links
    std::span<const glm::vec3> off;         ///< [N] [lx] its deviation, see LightGroups
    const std::vector<glm::vec3>& albedo;   ///< [N]
    std::span<const glm::vec3> irradiance;  ///< [N] [lx] H, filtered if requested
};

/// Solves again over each half of the links, with its half of the shadow rays, so that the estimate
/// includes noise transported by bounces. filter: null, or with the weights of H; its weights are
/// changed.
KeptError error_of(const LightAtRest& light, DisplayFilter* filter,
                   const ProgressCallback& progress = {});

}  // namespace lumel
