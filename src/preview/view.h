#pragma once
// From where a scene is shown.

#include "rays/ray_scene.h"
#include "scene/scene.h"

namespace lumel {

/// A camera position with its projection.
struct View {
    glm::mat4 transform{1.0f};         ///< looks along -z, +y up
    float vertical_fov = 0.9f;         ///< [rad]
    float aspect = 1.5f;               ///< width / height
    float orthographic_height = 0.0f;  ///< [m], > 0: orthographic
};

/// The scene's first camera, or one chosen to show most of what is there: inside of a room,
/// before an object.
View choose_view(const Scene& scene, const RayScene& rays);

}  // namespace lumel
