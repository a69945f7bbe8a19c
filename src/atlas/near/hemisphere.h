#pragma once
// Hemisphere rays of lumels.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"

namespace lumel {

/// Cosine-distributed direction about unit normal n, for (s, t) in the unit square.
inline glm::vec3 direction_about(const glm::vec3& n, const glm::vec2& st)
{
    const glm::vec3 side = std::abs(n.x) < 0.7f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 u = glm::normalize(glm::cross(side, n));
    const glm::vec3 v = glm::cross(n, u);
    const float radius = std::sqrt(st.x);
    const float angle = 2.0f * std::numbers::pi_v<float> * st.y;
    const glm::vec3 flat = radius * (std::cos(angle) * u + std::sin(angle) * v);
    return glm::normalize(flat + std::sqrt(std::max(0.0f, 1.0f - st.x)) * n);
}

/// True if the surface at the hit is double-sided.
inline bool is_double_sided(const Scene& scene, const RayHit& hit)
{
    const Mesh& mesh = scene.meshes[scene.instances[hit.instance].mesh];
    return scene.materials[mesh.primitives[hit.primitive].material].double_sided;
}

}  // namespace lumel
