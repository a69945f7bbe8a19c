#include "scene/values/origin.h"

#include <cmath>

namespace lumel {
namespace {

/// At this multiple of its size from 0, a scene has a float precision of a few millionths of its
/// size.
constexpr double kFarAway = 64.0;

}  // namespace

glm::dvec3 origin_for(const Bounds& scene)
{
    const double size = glm::distance(scene.low, scene.high);
    const glm::dvec3 middle = 0.5 * (scene.low + scene.high);
    if (!(size > 0.0) || glm::length(middle) <= kFarAway * size)
        return glm::dvec3(0.0);
    // Rounds to a power of two, so that coordinates with few digits keep them, and an edited scene
    // keeps its origin.
    const double step = std::exp2(std::ceil(std::log2(size)));
    return step * glm::round(middle / step);
}

void set_origin(Scene& scene, const glm::dvec3& origin)
{
    if (scene.origin == origin)
        return;
    const glm::dvec4 change(scene.origin - origin, 0.0);
    const auto move = [&](glm::mat4& transform) {
        transform[3] = glm::vec4(glm::dvec4(transform[3]) + change);
    };
    for (Instance& instance : scene.instances)
        move(instance.transform);
    for (PunctualLight& light : scene.lights)
        move(light.transform);
    for (Camera& camera : scene.cameras)
        move(camera.transform);
    scene.origin = origin;
}

}  // namespace lumel
