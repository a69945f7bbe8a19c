#pragma once
// Which lumels are close to each other and face each other.

#include <algorithm>
#include <cstdint>
#include <vector>

#include "nearfield/world_lumels.h"

namespace lumel {

/// The rule that receiver kernels repeat in nearfield/near_pairs.glsl: centres (world) closer than
/// radius × max(size_i, size_j). Such pairs are the table's alone, even where factor is 0.
inline bool is_near(const glm::vec3& centre_i, float size_i, const glm::vec3& centre_j,
                    float size_j, float radius)
{
    const glm::vec3 offset = centre_j - centre_i;
    const float reach = radius * std::max(size_i, size_j);
    return glm::dot(offset, offset) < reach * reach;
}

/// For each lumel i the partners j, ascending: partner[k], k in [first[i], first[i + 1]).
struct NearPairs {
    std::vector<std::size_t> first;      ///< [N + 1]
    std::vector<std::size_t> middle;     ///< [N] first k of row i with partner[k] > i
    std::vector<std::uint32_t> partner;  ///< [nnz]
    std::vector<std::uint32_t> mirror;   ///< [nnz] where the row of j holds i, if j > i
};

/// Finds all pairs that are near by is_near() and not plainly turned away from each other.
/// Lumels flagged kLumelBuried have no partners.
NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius);

}  // namespace lumel
