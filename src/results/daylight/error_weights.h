#pragma once
// Weights of lumels in the error of daylight.

#include <span>
#include <vector>

#include "atlas/prepare/solve_scene.h"

namespace lumel {

/// [N] 1 for lumels that see more than a third of the sky, by its light there, glass included [lx]
/// for a luminance of 1 cd/m².
std::vector<char> sees_sky(std::span<const float> light);

/// [N] Weight of each lumel's squared error: its area, divided by the square of its usual light, so
/// that errors in dim rooms count as those outdoors do. Lumels that see the sky have as much weight
/// together as all others, or errors in rooms would be lost beside wide ground. light: in any unit.
std::vector<float> error_weights(const SolveScene& scene, std::span<const float> light,
                                 std::span<const char> sees_sky);

}  // namespace lumel
