#pragma once
// Standard deviation of lumel estimates, as RMS over neighbours.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Distance of neighbours [texels]. Where few of them tell the deviation, it grows up to `most`.
struct NearReach {
    int least, most;
};

/// Of light along rays, and of direct light, whose edges are narrow.
inline constexpr NearReach kIndirectReach{2, 2}, kDirectReach{1, 1};

/// Root of the mean of `square` over each lumel, with weight `own`, and its neighbours within
/// `reach` on the same side of its chart; in charts too small to have enough of them, those beside
/// it in `order` [N]. Errors of other surfaces are unrelated. square, result: [N] by lumel. Value:
/// double, or glm::dvec3 for three quantities.
template <class Value>
std::vector<Value> deviation_nearby(const std::vector<Value>& square, const Lumels& lumels,
                                    const std::vector<std::uint32_t>& order, NearReach reach,
                                    double own);

}  // namespace lumel
