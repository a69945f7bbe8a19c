#pragma once
// Pairs of lumels too close for point sampling, solved exactly.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/near/near_pairs.h"
#include "atlas/near/surroundings.h"
#include "atlas/packing/atlas.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"

namespace lumel {

struct NearFieldOptions {
    float radius = 12.0f;  ///< pairs closer than this × the larger of the two lumel sizes
    std::size_t most_pairs = 12'000'000;  ///< the radius shrinks until about this number is left
    int samples = 16;     ///< points per close pair; four times as many where it is half hidden
    bool centre = false;  ///< receivers at their centroid (centre rule), not spread (area)
    std::uint32_t seed = 1;
    bool surroundings = false;  ///< finds NearField::around too
};

/// Sparse form factors, one row per receiver i (compressed rows):
/// H_i(near) = Σ_k factor[k] B[column[k]], k in [first[i], first[i + 1]).
struct NearField {
    float radius = 0.0f;                ///< it was built with, at most NearFieldOptions::radius
    std::vector<std::uint32_t> first;   ///< [N + 1]
    std::vector<std::uint32_t> column;  ///< [nnz] shooter j
    std::vector<float> factor;          ///< [nnz] F_ij × visible fraction
    Surroundings around;                ///< of the lumels, if NearFieldOptions requests them
};

/// Builds the table. Columns ascend in each row. Buried lumels have empty rows and appear in no
/// column. No row adds up to more than 1; with the area rule A_i F_ij = A_j F_ji holds between flat
/// lumels.
NearField build_near_field(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                           const NearFieldOptions& options);

/// Pairs that build_near_field() looks at: as many as its table has, and those that do not see each
/// other.
std::uint64_t count_near_pairs(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                               const NearFieldOptions& options);

/// The table of pairs of which both lumels are chosen [N], with the radius given.
NearField build_near_field_among(const std::vector<char>& chosen, const Scene& scene,
                                 const RayScene& rays, const Lumels& lumels,
                                 NearFieldOptions options);

/// Irradiance per radiosity (form factor) at point x with unit normal n from a convex polygon
/// with uniform radiosity, clipped to x's horizon: Lambert's edge sum. The polygon emits from
/// the side that sees its corners counter-clockwise; from the other side the result is 0.
float polygon_form_factor(const glm::vec3& x, const glm::vec3& n, const glm::vec3* corners,
                          int count);

}  // namespace lumel
