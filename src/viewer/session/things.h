#pragma once
// Objects that the user or the animation can move.

#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scene/values/animation.h"

namespace lumel {

/// Instances that move as one.
struct MovableObject {
    std::string name;
    std::vector<std::uint32_t> instances;
    bool played = false;        ///< moved by the animation
    glm::mat4 animation{1.0f};  ///< world-space motion by the animation
    glm::mat4 by_hand{1.0f};    ///< motion by the user, applied after it
    bool deleted = false;
};

/// All animated objects; and instances of these names, or without names the largest 64 instances
/// that are small relative to the scene. Throws Error{input} for a name that is not in the scene.
std::vector<MovableObject> find_things(const Scene& scene, const Animation& animation,
                                       const std::vector<std::string>& movable);

/// Corners of an instance's world-space bounds [m].
std::pair<glm::vec3, glm::vec3> bounds_of(const Scene& scene, std::uint32_t instance);

}  // namespace lumel
