#pragma once
// Which lumels are close to each other and face each other.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "atlas/near/world_lumels.h"

namespace lumel {

/// The rule that receiver kernels repeat in raster/near/near_pairs.glsl: centres (world) closer
/// than radius × max(size_i, size_j). Such pairs are the table's alone, even where factor is 0.
inline bool is_near(const glm::vec3& centre_i, float size_i, const glm::vec3& centre_j,
                    float size_j, float radius)
{
    const glm::vec3 offset = centre_j - centre_i;
    const float reach = radius * std::max(size_i, size_j);
    return glm::dot(offset, offset) < reach * reach;
}

/// For some lumels, one to a row, their partners: each pair stands in both of its rows.
struct NearPairs {
    std::vector<std::uint32_t> lumel;    ///< [M] of each row, ascending
    std::vector<std::size_t> first;      ///< [M + 1] partner[k], k in [first[row], first[row + 1])
    std::vector<std::size_t> middle;     ///< [M] first k of a row with partner[k] > row
    std::vector<std::uint32_t> partner;  ///< [nnz] rows, ascending in each row
    std::vector<std::uint32_t> mirror;   ///< [nnz] where the partner's row has it, if partner > row

    std::size_t rows() const { return lumel.size(); }
    std::uint32_t partner_of(std::size_t k) const { return lumel[partner[k]]; }
};

/// Finds all pairs of the lumels that are near by is_near() and not plainly turned away from each
/// other. Lumels flagged kLumelBuried have no partners.
NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius);

/// The same of some lumels, ascending, and of those of their pairs that are wanted.
using WantsPair = std::function<bool(std::uint32_t i, std::uint32_t j)>;
NearPairs find_near_pairs(const WorldLumels& world, const Lumels& lumels, float radius,
                          std::vector<std::uint32_t> some, const WantsPair& wants);

/// The largest of a few radii, `radius` and less, with about `most_pairs` at most, judged by the
/// neighbours of some of the lumels.
float fitting_radius(const WorldLumels& world, float radius, std::size_t most_pairs);

}  // namespace lumel
