#pragma once
// [Hoef13] figures 4.5.3, 4.5.4 and 5.2.1 to 5.2.5.

#include "bench/papers/dynamic_tables.h"
#include "bench/papers/figures.h"

namespace lumel::bench {

/// Figures 5.2.1 to 5.2.4: the scene by all techniques at rest, by our default and by paths.
Picture draw_techniques(const gpu::Device& device, const Scene& scene, const Atlas& atlas,
                        const Lumels& lumels, const ThesisScene& which,
                        const DynamicSettings& settings, const MoveResults& results);

/// Figure 4.5.3, paper-cross with and without reprojection; figure 4.5.4, what moves add up to in
/// paper-cross-incremental; figure 5.2.5, a box that touches the floor.
void draw_artefacts(const gpu::Device& device, const DynamicSettings& settings, Report& report);

}  // namespace lumel::bench
