#pragma once
// Which lumels are close to each other and face each other.

#include <cstdint>
#include <vector>

#include "nearfield/world_lumels.h"

namespace lumel {

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
