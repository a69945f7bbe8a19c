#pragma once
// Frames about a direction.

#include <cmath>

#include <glm/glm.hpp>

namespace lumel {

/// (t, b, axis), orthonormal and right-handed, about a unit axis.
inline glm::mat3 frame_about(const glm::vec3& axis)
{
    const glm::vec3 other = std::abs(axis.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 t = glm::normalize(glm::cross(other, axis));
    return {t, glm::cross(axis, t), axis};
}

/// The cube face that a direction points to: 0 to 5 for +x, -x, +y, -y, +z, -z.
inline int cube_side(const glm::vec3& direction)
{
    const glm::vec3 size = glm::abs(direction);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return 2 * axis + (direction[axis] < 0.0f ? 1 : 0);
}

}  // namespace lumel
