#pragma once
// Scenes that lie far from 0, as on map coordinates: floats are too coarse there.

#include "scene/values/geometry_checks.h"
#include "scene/values/scene.h"

namespace lumel {

/// Where a scene in this box should have its 0 [m]: in its middle, to a power of two, if it lies
/// far out for its size; else where it is.
glm::dvec3 origin_for(const Bounds& scene);

/// Moves the scene's 0, and all that stands in the scene the other way.
void set_origin(Scene& scene, const glm::dvec3& origin);

}  // namespace lumel
