#pragma once
// A point on a surface from which a path continues.

#include <glm/glm.hpp>

#include "truth/brdf.h"

namespace lumel {

/// A vertex of a path, offset from the surface on the side of its next ray.
struct PathVertex {
    glm::vec3 position;   ///< [m] world
    glm::vec3 geometric;  ///< unit normal of the triangle
    Brdf brdf;            ///< with the shading normal, for cosines
};

/// Cosine between the shading normal and a direction; 0 for directions that the path cannot take.
inline float cosine_above(const PathVertex& vertex, const glm::vec3& direction)
{
    const float cosine = glm::dot(vertex.brdf.normal(), direction);
    return cosine > 0.0f && glm::dot(vertex.geometric, direction) > 0.0f ? cosine : 0.0f;
}

}  // namespace lumel
