#pragma once
// A point on a surface from where a path looks for light.

#include <glm/glm.hpp>

#include "reference/brdf.h"

namespace lumel {

/// Where a path stands, lifted off the surface, on the side it may look to.
struct Stand {
    glm::vec3 position;   ///< [m] world
    glm::vec3 geometric;  ///< unit normal of the triangle
    Brdf brdf;            ///< with the shading normal, which cosines are taken with
};

/// Cosine at the surface of a direction that it may look to; 0 for all others.
inline float cosine_above(const Stand& stand, const glm::vec3& direction)
{
    const float cosine = glm::dot(stand.brdf.normal(), direction);
    return cosine > 0.0f && glm::dot(stand.geometric, direction) > 0.0f ? cosine : 0.0f;
}

}  // namespace lumel
