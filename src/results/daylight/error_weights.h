#pragma once
// How much each lumel counts in the error of daylight.

#include <span>
#include <vector>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

/// Lumels from which more than this part of the rays leaves to the sky are open to it.
inline constexpr double kOpenToSky = 1.0 / 3.0;

/// [N] By its area, and by its light in a typical hour [lx], since an eye adapts to a room as to
/// its garden: weight times squared error is relative to that light. Lumels open to the sky have as
/// much weight together as all others, lest wide ground decide alone.
std::vector<float> error_weights(const SolveScene& scene, std::span<const float> light,
                                 std::span<const char> open);

}  // namespace lumel
