#pragma once
// Reflectance of a surface at a point.

#include <glm/glm.hpp>

namespace lumel {

struct Reflectance {
    glm::vec3 diffuse{0.0f};   ///< ρ_d
    glm::vec3 specular{0.0f};  ///< ρ_s; ρ_d + ρ_s ≤ 1
    float shininess = 1.0f;    ///< n
};

}  // namespace lumel
