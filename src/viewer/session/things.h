#pragma once
// What of a scene may be moved by hand, or is moved by its animation.

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
    glm::mat4 animation{1.0f};  ///< from its place in the scene to where that has it, world
    glm::mat4 by_hand{1.0f};    ///< from there on
    bool deleted = false;
};

/// All that the animation moves; and instances of these names, or where there are none all that are
/// small beside the scene, the largest 64 of them. Throws Error{input} for a name that the scene
/// does not have.
std::vector<MovableObject> find_things(const Scene& scene, const Animation& animation,
                                       const std::vector<std::string>& movable);

/// Corners of an instance's box where the scene has it [m].
std::pair<glm::vec3, glm::vec3> bounds_of(const Scene& scene, std::uint32_t instance);

}  // namespace lumel
