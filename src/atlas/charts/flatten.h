#pragma once
// Projection to a plane, and minimal bounding rectangles.

#include <span>

#include <glm/glm.hpp>

namespace lumel {

/// Coordinates in the plane through `origin`, seen against `normal`: u to the right, v down, as in
/// an image, so u × v = -normal.
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

/// Rotates and translates the points into 0…size of their smallest bounding rectangle, longer side
/// horizontal. Returns its size. Edges of a rectangle become axis-parallel.
glm::dvec2 turn_to_tight_rectangle(std::span<glm::dvec2> points);

}  // namespace lumel
