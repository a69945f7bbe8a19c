#pragma once
// From space to a plane, and the tightest rectangle there.

#include <span>

#include <glm/glm.hpp>

namespace lumel {

/// Coordinates in the plane through `origin`, seen from where `normal` points to: u to the
/// right, v down, as in an image. So u × v = -normal.
class PlaneFrame {
public:
    PlaneFrame(const glm::dvec3& normal, const glm::dvec3& origin);

    glm::dvec2 project(const glm::dvec3& point) const
    {
        return {glm::dot(point - origin_, right_), glm::dot(point - origin_, down_)};
    }

private:
    glm::dvec3 origin_, right_, down_;
};

/// Turns and shifts the points so that they fill 0…size of the smallest rectangle round them,
/// lying on its longer side. Returns its size. Edges of a rectangle become parallel to the axes.
glm::dvec2 turn_to_tight_rectangle(std::span<glm::dvec2> points);

}  // namespace lumel
