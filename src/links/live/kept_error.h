#pragma once
// How far light over kept links is off, as parts of their rays tell.

#include <span>
#include <vector>

#include "base/core/progress_callback.h"
#include "links/live/display_filter.h"
#include "links/live/lumel_sweeps.h"

namespace lumel {

/// Relative, in the sense of SolverState::error and dark_error; < 0: of no light there is none.
struct KeptError {
    double all = -1.0, dark = -1.0;
};

/// Light at rest over the links of a scene.
struct LightAtRest {
    const LumelLinks& links;
    const LumelSweeps& sweeps;
    std::span<const Lumel> lumels;         ///< [N]
    std::span<const glm::vec3> lamps;      ///< [N] [lx] direct light but what rays bring of the sky
    std::span<const glm::vec3> off;        ///< [N] [lx] of that, see LightGroups
    const std::vector<glm::vec3>& albedo;  ///< [N]
    std::span<const glm::vec3> irradiance;  ///< [N] [lx] H, filtered where that is wanted
};

/// Lights the scene over either half of the links, each with its half of the rays to lamps and sky,
/// so that what bounces carry of their noise is in it. filter: null, or with the weights of H,
/// which are others afterwards.
KeptError error_of(const LightAtRest& light, DisplayFilter* filter,
                   const ProgressCallback& progress = {});

}  // namespace lumel
