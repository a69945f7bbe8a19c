#pragma once
// Groups of neighbouring patches that face the same direction.

#include <cstdint>
#include <vector>

#include "solve/matrix/elements.h"

namespace lumel {

/// An order of all patches in which each run of `size` is a cluster; the last may be shorter.
/// Halves are cut where places and normals spread most.
std::vector<std::uint32_t> cluster_order(const Elements& elements, std::uint32_t size);

}  // namespace lumel
