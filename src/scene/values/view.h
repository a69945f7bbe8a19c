#pragma once
// From where a scene is shown.

#include "scene/values/scene.h"

namespace lumel {

inline constexpr float kFreeAspect = 1.5f;  ///< width / height of a view that leaves it open

/// A camera position with its projection.
struct View {
    glm::mat4 transform{1.0f};         ///< looks along -z, +y up
    float vertical_fov = 0.9f;         ///< [rad]
    float aspect = kFreeAspect;        ///< width / height
    float orthographic_height = 0.0f;  ///< of the picture [m], > 0: orthographic
};

struct Ray {
    glm::vec3 origin{0.0f};     ///< [m] world
    glm::vec3 direction{0.0f};  ///< unit
};

/// The ray through a place of the picture, (0, 0) at its top left and (1, 1) at its bottom right.
Ray ray_through(const View& view, const glm::vec2& place);

/// Height of a picture of that width and shape, 1 to `most` [pixels].
int picture_height(int width, float aspect, int most);

/// What a camera of the scene shows.
inline View view_of(const Camera& camera)
{
    return {camera.transform, camera.vertical_fov,
            camera.aspect > 0.0f ? camera.aspect : kFreeAspect, camera.orthographic_height};
}

}  // namespace lumel
