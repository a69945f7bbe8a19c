#pragma once
// Scenes far from 0, as in map coordinates, where floats are too coarse.

#include "scene/values/geometry_checks.h"
#include "scene/values/scene.h"

namespace lumel {

/// Origin [m] for a scene with these bounds: near its centre, rounded to a power of two, if it is
/// far out relative to its size; else 0.
glm::dvec3 origin_for(const Bounds& scene);

/// Moves the scene's origin, and its contents the opposite way.
void set_origin(Scene& scene, const glm::dvec3& origin);

}  // namespace lumel
