#pragma once
// Scenes far from 0, as in map coordinates, where floats are too coarse.

#include <cstddef>
#include <limits>

#include "scene/values/geometry_checks.h"
#include "scene/values/scene.h"

namespace lumel {

/// Origin [m] for a scene with these bounds: near its centre, rounded to a power of two, if it is
/// far out relative to its size; else 0.
glm::dvec3 origin_for(const Bounds& scene);

/// The same for the scene's instances. world_of(instance): its transform in the file's world, in
/// doubles.
template <class Place>
glm::dvec3 origin_for(const Scene& scene, const Place& world_of)
{
    constexpr double kBeyond = std::numeric_limits<double>::max();
    Bounds whole{glm::dvec3(kBeyond), glm::dvec3(-kBeyond)};
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[std::size_t(instance.mesh)];
        if (mesh.primitives.empty())
            continue;
        const Bounds box = placed_box(bounds_of(mesh), world_of(instance));
        whole.low = glm::min(whole.low, box.low);
        whole.high = glm::max(whole.high, box.high);
    }
    return whole.low.x <= whole.high.x ? origin_for(whole) : glm::dvec3(0.0);
}

/// Moves the scene's origin, and its contents the opposite way.
void set_origin(Scene& scene, const glm::dvec3& origin);

}  // namespace lumel
