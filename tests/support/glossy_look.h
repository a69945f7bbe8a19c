#pragma once
// Materials of a wanted reflectance.

#include <algorithm>
#include <cmath>

#include "scene/values/scene.h"
#include "truth/brdf.h"

namespace lumel::support {

/// Lets gloss count in a scene, and gives a material that look: a dielectric whose F0 is ρ_s.
inline void make_glossy(Scene& scene, std::size_t material, const Reflectance& look)
{
    const glm::vec3& f0 = look.specular;
    Material& made = scene.materials[material];
    scene.model = MaterialModel::glossy;
    made.metallic = 0.0f;
    made.dielectric_specular = f0;
    made.base_color =
        glm::vec4(look.diffuse / std::max(1e-6f, 1.0f - std::max({f0.r, f0.g, f0.b})), 1.0f);
    // The inverse of shininess_of.
    made.roughness = std::pow(1.0f / (2.0f * look.shininess + 1.0f), 0.25f);
}

}  // namespace lumel::support
