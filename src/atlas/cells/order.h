#pragma once
// The order in which lumels send rays.

#include <cstdint>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

/// Lumels [N] such that neighbours in space that face alike come together: their rays meet the same
/// things.
std::vector<std::uint32_t> order_in_space(const WorldLumels& world);

}  // namespace lumel
