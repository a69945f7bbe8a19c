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

}  // namespace lumel
