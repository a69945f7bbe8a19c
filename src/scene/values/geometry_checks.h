#pragma once
// Checks and repairs of geometry, for all readers.

#include <cstddef>

#include "scene/values/scene.h"

namespace lumel {

/// Larger coordinates [m or mesh units] would overflow areas in float arithmetic.
inline constexpr float kLargestCoordinate = 1e9f;

/// Drops triangles whose area floats cannot resolve. Returns their number.
std::size_t drop_zero_area(Primitive& primitive);

/// Normalises all normals; those without a direction get that of their faces. Returns the number of
/// the latter.
std::size_t repair_normals(Primitive& primitive);

/// True if the columns of the matrix (nearly) lie in a plane: it leaves no volume and no normals.
bool is_flat(const glm::dmat4& matrix);

/// Axis-aligned box in doubles, for coordinates as in a file.
struct Bounds {
    glm::dvec3 low{0.0};
    glm::dvec3 high{0.0};
};

/// Bounds in mesh space; empty for a mesh without primitives.
Bounds bounds_of(const Mesh& mesh);

/// Bounds of a transformed box in the world.
Bounds placed_box(const Bounds& box, const glm::dmat4& world);

/// True if float arithmetic would fail somewhere in the transformed box.
bool reaches_too_far(const Bounds& box, const glm::dmat4& world);

}  // namespace lumel
