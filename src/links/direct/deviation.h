#pragma once
// Standard deviation of lumel estimates, as RMS over neighbours.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Distance of neighbours [texels]: of light along rays, and of direct light, whose edges are
/// narrow.
inline constexpr int kIndirectReach = 2, kDirectReach = 1;

/// Root of the mean of `square` over each lumel, with weight `own`, and its neighbours within
/// `reach` texels on the same side of its chart; in charts too small to have enough of them, those
/// beside it in `order` [N]. Errors of other surfaces are unrelated. square, result: [N] by lumel.
/// Value: double, or glm::dvec3 for three quantities.
template <class Value>
std::vector<Value> deviation_nearby(const std::vector<Value>& square, const Lumels& lumels,
                                    const std::vector<std::uint32_t>& order, int reach, double own);

}  // namespace lumel
