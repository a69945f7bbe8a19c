#pragma once
// BRDF of a point: a diffuse part and a stretched Phong lobe. Independent of the solvers that it
// tests.
//
// [NNS99] L. Neumann, A. Neumann, L. Szirmay-Kalos, Compact Metallic Reflectance Models, 1999.

#include <glm/glm.hpp>

#include "rays/paths/reflectance.h"

namespace lumel {

/// f_r(ω, ω') for one direction ω, with sampling of ω':
///
///     f_r = ρ_d / π + ρ_s (n + 1) / 2π · max(0, m · ω')ⁿ / max(cosθ, cosθ'),
///
/// where m is the mirror direction of ω. All directions are unit and point away from the surface.
class Brdf {
public:
    Brdf(const Reflectance& look, const glm::vec3& normal, const glm::vec3& toward);
    /// White diffuse: reflects the irradiance, H = πL.
    explicit Brdf(const glm::vec3& normal) : Brdf({glm::vec3(1.0f)}, normal, normal) {}

    const glm::vec3& normal() const { return normal_; }

    /// ρ_d + ρ_s, an upper bound of the albedo.
    const glm::vec3& reflectance() const { return reflectance_; }

    /// Value and density for one incoming direction.
    struct Response {
        glm::vec3 shape{0.0f};  ///< π f_r / reflectance(): 1 for a matte surface
        float density = 0.0f;   ///< [1/sr] density of `sample`
    };
    /// Requires a direction above the surface.
    Response respond(const glm::vec3& incoming) const;

    /// Maps a point of the unit square to a direction, cosine-distributed about the normal or
    /// lobe-distributed about m, by their strengths. Can be below the surface.
    glm::vec3 sample(glm::vec2 at) const;

private:
    glm::vec3 normal_;
    glm::vec3 mirror_;       ///< m
    glm::vec3 reflectance_;  ///< ρ_d + ρ_s
    glm::vec3 gloss_;        ///< ρ_s / (ρ_d + ρ_s)
    float shininess_;
    float cos_toward_;
    float chance_;  ///< probability of sampling the lobe
};

}  // namespace lumel
