#pragma once
// Which object of an edited scene is which of the scene before.

#include <cstdint>
#include <vector>

#include "scene/values/scene.h"

namespace lumel {

inline constexpr std::uint32_t kNoInstance = ~0u;

/// Pairs of instances with equal triangles, in equal order, that block light alike. What they
/// reflect and emit may differ.
struct Matches {
    std::vector<std::uint32_t> before;  ///< [instances after] its number before; kNoInstance: new
    std::vector<std::uint32_t> after;   ///< [instances before] its number now; kNoInstance: gone
    std::vector<char> moved;            ///< [instances after] 1: it stands elsewhere, or is new
};

/// Of several that could be meant, one in the same place, else one of the same name, else the
/// first.
Matches match_instances(const Scene& before, const Scene& after);

}  // namespace lumel
