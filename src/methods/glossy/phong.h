#pragma once
// Stretched Phong model on the CPU, equal to phong.glsl.
//
//   [NNS99] L. Neumann, A. Neumann, L. Szirmay-Kalos. Compact Metallic Reflectance Models.
//           Computer Graphics Forum 18(3), 1999.
//
// With the mirror direction m of ω about the normal, and c = max(0, m · ω'):
//
//     f_r(ω, ω') = ρ_d / π  +  ρ_s (n + 1) / 2π · cⁿ / max(cosθ, cosθ')
//
// The lobe (n + 1) / 2π cⁿ has the integral 1 over all directions, and cosθ' / max(…) ≤ 1, so the
// albedo is at most ρ_d + ρ_s for any direction.

#include <vector>

#include "methods/glossy/phong.shared.h"

namespace lumel {

/// Density of the lobe [1/sr]. `mirrored`: m · ω'.
float phong_density(float mirrored, float shininess);

/// Maps a point of the unit square to a direction of that density about unit `mirror`, possibly
/// below the surface.
glm::vec3 phong_direction(const glm::vec3& mirror, float shininess, const glm::vec2& at);

/// f_r without ρ_s, for ρ_d = 0 [1/sr]. `mirrored`: m · ω'.
float phong_lobe(float cos_in, float cos_out, float mirrored, float shininess);

/// Albedo of the lobe for light from cosθ: ∫ f_r cosθ' dω', ρ_s = 1. 0…1.
float phong_albedo(float cos_in, float shininess);

/// phong_albedo [kAlbedoExponents][kAlbedoCosines + 1]; the last column is the mean over diffuse
/// incoming light.
std::vector<float> phong_albedo_table();

}  // namespace lumel
