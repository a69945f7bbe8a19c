#pragma once
// Axis-aligned boxes.

#include <glm/glm.hpp>

namespace lumel {

/// An axis-aligned box [m].
struct Box {
    glm::vec3 low{0.0f}, high{0.0f};

    glm::vec3 centre() const { return 0.5f * (low + high); }
    float radius() const { return 0.5f * glm::distance(low, high); }  ///< bounding radius

    /// True if a ray along `direction` (unit) may hit the box, grown by `margin` [m] on all sides,
    /// before `far` [m].
    bool may_meet(const glm::vec3& origin, const glm::vec3& direction, float far,
                  float margin) const;

    /// True if a segment from a point of `from` to a point of `to` can intersect this box. Exact:
    /// the possible positions at each segment parameter are a box, interpolated between the two.
    bool may_lie_between(const Box& from, const Box& to) const;

    /// The box grown by a margin [m] on all sides.
    Box grown(float margin) const { return {low - margin, high + margin}; }

    /// Squared distance of a point from the box [m²], 0 inside.
    float distance2(const glm::vec3& point) const
    {
        const glm::vec3 d = point - glm::clamp(point, low, high);
        return glm::dot(d, d);
    }
};

}  // namespace lumel
