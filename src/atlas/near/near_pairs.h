#pragma once
// Pairs of lumels that are close and face each other.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

/// True if centres (world) are closer than radius × max(size_i, size_j). Receiver kernels duplicate
/// this in raster/near/near_pairs.glsl. Such pairs are only in the table, even if their factor is
/// 0.
inline bool is_near(const glm::vec3& centre_i, float size_i, const glm::vec3& centre_j,
                    float size_j, float radius)
{
    const glm::vec3 offset = centre_j - centre_i;
    const float reach = radius * std::max(size_i, size_j);
    return glm::dot(offset, offset) < reach * reach;
}

/// Partners of some lumels, one row each; each pair is in both of its rows.
struct NearPairs {
    std::vector<std::uint32_t> lumel;    ///< [M] lumel of each row, ascending
    std::vector<std::size_t> first;      ///< [M + 1] partner[k], k in [first[row], first[row + 1])
    std::vector<std::size_t> middle;     ///< [M] first k of a row with partner[k] > row
    std::vector<std::uint32_t> partner;  ///< [nnz] rows, ascending in each row
    std::vector<std::uint32_t> mirror;   ///< [nnz] its index in the partner's row, if partner > row

    std::size_t rows() const { return lumel.size(); }
    std::uint32_t partner_of(std::size_t k) const { return lumel[partner[k]]; }
};

/// Finds all pairs that satisfy is_near() and do not clearly face away from each other. Buried
/// lumels have no partners.
NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius);

/// Finds only the wanted pairs of some lumels, ascending.
using WantsPair = std::function<bool(std::uint32_t i, std::uint32_t j)>;
NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius,
                          std::vector<std::uint32_t> some, const WantsPair& wants);

/// The largest of a few radii up to `radius` with about `most_pairs` pairs, estimated from a
/// sample of the lumels.
float fitting_radius(const WorldLumels& world, float radius, std::size_t most_pairs);

}  // namespace lumel
