#pragma once
// Maps from the unit square to directions, and their frames.

#include <cmath>

#include <glm/glm.hpp>

#include "base/core/pi.h"

namespace lumel {

/// Direction x, y, z in a branch-free frame about the unit vector `axis`. [DBC*17]
inline glm::vec3 turn_to(const glm::vec3& axis, float x, float y, float z)
{
    const float sign = std::copysign(1.0f, axis.z);
    const float a = -1.0f / (sign + axis.z);
    const float b = axis.x * axis.y * a;
    const glm::vec3 tangent(1.0f + sign * axis.x * axis.x * a, sign * b, -sign * axis.x);
    const glm::vec3 bitangent(b, sign + axis.y * axis.y * a, -axis.y);
    return x * tangent + y * bitangent + z * axis;
}

/// Concentric map from the unit square to the unit disc: preserves areas and keeps strata compact.
inline glm::vec2 square_to_disc(const glm::vec2& at)
{
    const glm::vec2 offset = 2.0f * at - 1.0f;
    if (std::abs(offset.x) > std::abs(offset.y)) {
        const float angle = kPi / 4.0f * (offset.y / offset.x);
        return offset.x * glm::vec2(std::cos(angle), std::sin(angle));
    }
    if (offset.y == 0.0f)
        return glm::vec2(0.0f);
    const float angle = kPi / 2.0f - kPi / 4.0f * (offset.x / offset.y);
    return offset.y * glm::vec2(std::cos(angle), std::sin(angle));
}

}  // namespace lumel
