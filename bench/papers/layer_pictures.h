#pragma once
// Pictures of [TN11] figures 2 and 8.

#include "base/core/image.h"
#include "bench/papers/figures.h"

namespace lumel::bench {

/// Figure 2: an illumination map of four cubes, and the number of surfaces behind each pixel, from
/// white for none to black. Display codes.
Image four_cubes_along_a_direction(const LayersSettings& settings, const gpu::Device& device);

/// Figure 8: radiosity of the lower side of the plane on top, seen straight from below, of `width`²
/// pixels [lm/m²].
Image plane_on_top(const SolveScene& world, const std::vector<glm::vec3>& irradiance, int width);

}  // namespace lumel::bench
