#pragma once
// Maps from the unit square to directions that preserve uniform distributions.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

namespace lumel {

/// Unit direction; uniform over the sphere for uniform `at`. at.x goes from +z to -z, at.y is the
/// azimuth.
inline glm::vec3 on_sphere(const glm::vec2& at)
{
    const float z = 1.0f - 2.0f * at.x, r = std::sqrt(std::max(1.0f - z * z, 0.0f));
    const float turn = 2.0f * std::numbers::pi_v<float> * at.y;
    return {r * std::cos(turn), r * std::sin(turn), z};
}

/// Uniform over the cone of half angle `angle` [rad] about +z; accurate for narrow cones too.
inline glm::vec3 in_cone(const glm::vec2& at, float angle)
{
    const float half_sine = std::sin(0.5f * angle);
    const float down = at.x * 2.0f * half_sine * half_sine;  // 1 - z
    const float r = std::sqrt(std::max(down * (2.0f - down), 0.0f));
    const float turn = 2.0f * std::numbers::pi_v<float> * at.y;
    return {r * std::cos(turn), r * std::sin(turn), 1.0f - down};
}

/// Cosine-distributed over the hemisphere about +z.
inline glm::vec3 by_cosine(const glm::vec2& at)
{
    const float r = std::sqrt(at.x), turn = 2.0f * std::numbers::pi_v<float> * at.y;
    return {r * std::cos(turn), r * std::sin(turn), std::sqrt(std::max(1.0f - at.x, 0.0f))};
}

}  // namespace lumel
