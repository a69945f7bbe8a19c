#include "scene/values/animation.h"

#include <algorithm>

namespace lumel {

namespace {

/// Position of a time between keys.
struct KeySpan {
    std::size_t key = 0;   ///< last key at or before the time
    double part = 0.0;     ///< fraction of the time to the next key, 0…1
    double seconds = 0.0;  ///< from this key to the next; 0 if there is none
};

KeySpan span_at(const Track& track, double time)
{
    const auto after = std::upper_bound(track.times.begin(), track.times.end(), time);
    if (after == track.times.begin())
        return {};
    const auto key = std::size_t(after - track.times.begin()) - 1;
    if (after == track.times.end())
        return {key};
    const double seconds = *after - track.times[key];
    return {key, (time - track.times[key]) / seconds, seconds};
}

/// A key's value; cubic splines store slopes beside it.
const glm::dvec4& key_value(const Track& track, std::size_t key)
{
    return track.values[track.interpolation == Interpolation::cubic_spline ? 3 * key + 1 : key];
}

/// Cubic Hermite spline, glTF 2.0 appendix C.5.
glm::dvec4 spline(const Track& track, const KeySpan& span)
{
    const double s = span.part, s2 = s * s, s3 = s2 * s;
    const glm::dvec4& slope_after = track.values[3 * span.key + 2];
    const glm::dvec4& slope_before_next = track.values[3 * span.key + 3];
    return (2.0 * s3 - 3.0 * s2 + 1.0) * key_value(track, span.key) +
           span.seconds * (s3 - 2.0 * s2 + s) * slope_after +
           (-2.0 * s3 + 3.0 * s2) * key_value(track, span.key + 1) +
           span.seconds * (s3 - s2) * slope_before_next;
}

glm::dquat to_quaternion(const glm::dvec4& v)
{
    return {v.w, v.x, v.y, v.z};
}

NodePlace place_at(const AnimatedNode& node, double time)
{
    NodePlace place = node.rest;
    if (node.translation)
        place.translation = glm::dvec3(value_at(*node.translation, time));
    if (node.rotation)
        place.rotation = rotation_at(*node.rotation, time);
    if (node.scale)
        place.scale = glm::dvec3(value_at(*node.scale, time));
    return place;
}

/// True if the node or an ancestor moves.
bool is_moved(const Animation& animation, int node)
{
    for (; node >= 0; node = animation.nodes[std::size_t(node)].parent)
        if (animation.nodes[std::size_t(node)].moves())
            return true;
    return false;
}

/// Component-wise maximum of the keys.
glm::dvec4 most_of(const Track& track)
{
    glm::dvec4 most(0.0);
    for (std::size_t key = 0; key < track.times.size(); ++key)
        most = glm::max(most, key_value(track, key));
    return most;
}

}  // namespace

glm::dvec4 value_at(const Track& track, double time)
{
    const KeySpan span = span_at(track, time);
    if (span.seconds == 0.0 || track.interpolation == Interpolation::step)
        return key_value(track, span.key);
    if (track.interpolation == Interpolation::cubic_spline)
        return spline(track, span);
    return glm::mix(key_value(track, span.key), key_value(track, span.key + 1), span.part);
}

glm::dquat rotation_at(const Track& track, double time)
{
    const KeySpan span = span_at(track, time);
    if (span.seconds == 0.0 || track.interpolation != Interpolation::linear)
        return glm::normalize(to_quaternion(value_at(track, time)));
    return glm::normalize(glm::slerp(to_quaternion(key_value(track, span.key)),
                                     to_quaternion(key_value(track, span.key + 1)), span.part));
}

glm::dmat4 transform_at(const Animation& animation, int node, double time)
{
    glm::dmat4 world(1.0);
    for (; node >= 0; node = animation.nodes[std::size_t(node)].parent)
        world = to_matrix(place_at(animation.nodes[std::size_t(node)], time)) * world;
    return world;
}

glm::vec3 emitted_at(const AnimatedMaterial& material, double time)
{
    const glm::dvec3 factor =
        material.factor ? glm::dvec3(value_at(*material.factor, time)) : material.rest_factor;
    const double strength =
        material.strength ? value_at(*material.strength, time).x : material.rest_strength;
    // Splines may be negative between keys.
    return glm::max(factor, 0.0) * std::max(strength, 0.0);
}

glm::vec3 most_emitted(const AnimatedMaterial& material)
{
    const glm::dvec3 factor =
        material.factor ? glm::dvec3(most_of(*material.factor)) : material.rest_factor;
    return factor * (material.strength ? most_of(*material.strength).x : material.rest_strength);
}

std::vector<std::uint32_t> movers_of(const Animation& animation, const Scene& scene)
{
    std::vector<std::uint32_t> movers;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (is_moved(animation, scene.instances[i].node))
            movers.push_back(i);
    return movers;
}

glm::mat4 place_in(const Scene& scene, const Animation& animation, int node, double time)
{
    glm::dmat4 world = transform_at(animation, node, time);
    world[3] -= glm::dvec4(scene.origin, 0.0);
    return world;
}

void pose(Scene& scene, const Animation& animation, double time)
{
    for (Instance& instance : scene.instances)
        if (is_moved(animation, instance.node))
            instance.transform = place_in(scene, animation, instance.node, time);
    for (Camera& camera : scene.cameras)
        if (is_moved(animation, camera.node))
            camera.transform = place_in(scene, animation, camera.node, time);
    for (const AnimatedMaterial& material : animation.materials)
        scene.materials[std::size_t(material.material)].emitted = emitted_at(material, time);
}

}  // namespace lumel
