#pragma once
// What geometry must be like to be lit, whoever brings it.

#include <cstddef>

#include "scene/values/scene.h"

namespace lumel {

/// Coordinates beyond this [m or mesh units] would overflow the float arithmetic of areas.
inline constexpr float kLargestCoordinate = 1e9f;

/// Drops triangles whose area floats cannot resolve. Returns how many.
std::size_t drop_zero_area(Primitive& primitive);

/// Makes every normal a unit vector. Those that have no direction get that of their faces. Returns
/// how many had none.
std::size_t repair_normals(Primitive& primitive);

/// A matrix whose columns (nearly) lie in a plane leaves no volume, nor normals.
bool is_flat(const glm::dmat4& matrix);

/// Corners of a box along the axes, in doubles: of coordinates as a file has them.
struct Bounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// In mesh space; empty for a mesh without primitives.
Bounds bounds_of(const Mesh& mesh);

/// Of a box so placed, in the world.
Bounds placed_box(const Bounds& box, const glm::dmat4& world);

/// True if float arithmetic breaks down somewhere in a box so placed.
bool reaches_too_far(const Bounds& box, const glm::dmat4& world);

}  // namespace lumel
