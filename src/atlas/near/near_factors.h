#pragma once
// Form factors of near pairs, before they become a table.

#include <span>
#include <vector>

#include "atlas/near/near_field.h"
#include "atlas/near/near_pairs.h"

namespace lumel {

/// Factors below this are not worth an entry.
inline constexpr float kMinFactor = 1e-7f;

/// F_ij × visible fraction of pairs [nnz], in their order. That of a pair depends on its two lumels
/// and on what lies between them alone.
std::vector<float> near_factors(const NearPairs& pairs, const RayScene& rays,
                                const WorldLumels& world, const Lumels& lumels,
                                const NearFieldOptions& options);

/// Scales a row that adds up to more than 1 down to 1; returns true if it did. In gaps much
/// narrower than a lumel the quadrature may overshoot, and a bright surface there would then
/// multiply its own light.
bool limit_row(std::span<float> row);

}  // namespace lumel
