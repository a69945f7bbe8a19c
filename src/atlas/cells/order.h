#pragma once
// Order in which lumels trace rays.

#include <cstdint>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

/// Lumels [N], sorted so that neighbours in space with similar normals are adjacent: their rays
/// hit the same surfaces.
std::vector<std::uint32_t> order_in_space(const WorldLumels& world);

}  // namespace lumel
