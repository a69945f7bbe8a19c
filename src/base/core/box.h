#pragma once
// Boxes along the axes.

#include <glm/glm.hpp>

namespace lumel {

/// A box along the axes [m].
struct Box {
    glm::vec3 low{0.0f}, high{0.0f};

    glm::vec3 centre() const { return 0.5f * (low + high); }
    float radius() const { return 0.5f * glm::distance(low, high); }  ///< of the ball around it

    /// May a ray along `direction` (unit) meet the box, grown by `margin` [m] to all sides, before
    /// `far` [m]?
    bool may_meet(const glm::vec3& origin, const glm::vec3& direction, float far,
                  float margin) const;

    /// May a line from a point of one box to one of another meet this one? Exactly so for boxes: as
    /// the line goes on, all places it may have are a box that changes from the one to the other.
    bool may_lie_between(const Box& from, const Box& to) const;

    /// The same, grown by a margin [m] to all sides.
    Box grown(float margin) const { return {low - margin, high + margin}; }

    /// Squared distance of a point from the box [m²], 0 inside.
    float distance2(const glm::vec3& point) const
    {
        const glm::vec3 d = point - glm::clamp(point, low, high);
        return glm::dot(d, d);
    }
};

}  // namespace lumel
