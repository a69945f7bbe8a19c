#pragma once
// Form factors of near pairs, before they become a table.

#include <span>
#include <vector>

#include "atlas/near/near_field.h"
#include "atlas/near/near_pairs.h"

namespace lumel {

/// Smaller factors have no entry.
inline constexpr float kMinFactor = 1e-7f;

/// F_ij × visible fraction of pairs [nnz], in their order. Each depends only on its two lumels and
/// the geometry between them.
std::vector<float> near_factors(const NearPairs& pairs, const RayScene& rays,
                                const WorldLumels& world, const Lumels& lumels,
                                const NearFieldOptions& options);

/// Scales a row with a sum above 1 down to 1; returns true if it did. In gaps much narrower than a
/// lumel the quadrature may exceed 1, and a bright surface would then multiply its own light.
bool limit_row(std::span<float> row);

}  // namespace lumel
