#pragma once
// Exact form factors of pairs of lumels too close for point sampling.

#include <algorithm>
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
    float radius = 12.0f;  ///< maximum distance of pairs, in sizes of the larger lumel
    std::size_t most_pairs = 12'000'000;  ///< approximate limit, enforced by a smaller radius
    int samples = 16;     ///< points per close pair; four times as many if partly visible
    bool centre = false;  ///< receivers at their centroid instead of distributed
    std::uint32_t seed = 1;
    bool surroundings = false;  ///< computes NearField::around too
};

/// Sparse form factors in compressed rows, one per receiver i: H_i(near) = Σ_k factor[k]
/// B[column[k]], k in [first[i], first[i + 1]).
struct NearField {
    float radius = 0.0f;                ///< radius used, at most NearFieldOptions::radius
    std::vector<std::uint32_t> first;   ///< [N + 1]
    std::vector<std::uint32_t> column;  ///< [nnz] shooter j
    std::vector<float> factor;          ///< [nnz] F_ij × visible fraction
    Surroundings around;                ///< if requested by NearFieldOptions
};

/// Builds the table. Columns ascend in each row. Buried lumels have empty rows and are in no
/// column. No row sum exceeds 1; with the area rule A_i F_ij = A_j F_ji holds between flat lumels.
NearField build_near_field(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                           const NearFieldOptions& options);

/// Number of pairs that build_near_field() tests: those in its table and occluded ones.
std::uint64_t count_near_pairs(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                               const NearFieldOptions& options);

/// The table of pairs of chosen lumels [N], with the given radius.
NearField build_near_field_among(const std::vector<char>& chosen, const Scene& scene,
                                 const RayScene& rays, const Lumels& lumels,
                                 NearFieldOptions options);

/// Form factor (irradiance per radiosity) at point x with unit normal n from a convex polygon of
/// uniform radiosity, clipped to x's horizon: Lambert's edge sum. Negative if x is on the side from
/// which its corners run clockwise.
float signed_form_factor(const glm::vec3& x, const glm::vec3& n, const glm::vec3* corners,
                         int count);

/// Form factor of a polygon that emits only from its counter-clockwise side; 0 on the other.
inline float polygon_form_factor(const glm::vec3& x, const glm::vec3& n, const glm::vec3* corners,
                                 int count)
{
    return std::max(signed_form_factor(x, n, corners, count), 0.0f);
}

}  // namespace lumel
