#pragma once
// Matches the objects of an edited scene to those before.

#include <cstdint>
#include <vector>

#include "scene/values/scene.h"

namespace lumel {

inline constexpr std::uint32_t kNoInstance = ~0u;

/// Pairs of instances with equal triangles in equal order that block light alike. Reflectance and
/// emission can differ.
struct Matches {
    std::vector<std::uint32_t> before;  ///< [instances after] index before; kNoInstance: new
    std::vector<std::uint32_t> after;   ///< [instances before] index after; kNoInstance: removed
    std::vector<char> moved;            ///< [instances after] 1: moved or new
};

/// Prefers candidates at the same position, then of the same name, then the first.
Matches match_instances(const Scene& before, const Scene& after);

}  // namespace lumel
