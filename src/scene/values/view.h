#pragma once
// Camera views.

#include "scene/values/scene.h"

namespace lumel {

inline constexpr float kFreeAspect = 1.5f;  ///< width / height of unspecified views

/// A camera position with its projection.
struct View {
    glm::mat4 transform{1.0f};         ///< camera to world; views along -z, +y up
    float vertical_fov = 0.9f;         ///< [rad]
    float aspect = kFreeAspect;        ///< width / height
    float orthographic_height = 0.0f;  ///< image height [m], > 0 if orthographic
};

struct Ray {
    glm::vec3 origin{0.0f};     ///< [m] world
    glm::vec3 direction{0.0f};  ///< unit
};

/// Ray through an image position; (0, 0) is the top left, (1, 1) the bottom right.
Ray ray_through(const View& view, const glm::vec2& place);

/// Height of an image of that width and aspect, 1 to `most` [pixels].
int picture_height(int width, float aspect, int most);

/// View of a scene camera.
inline View view_of(const Camera& camera)
{
    return {camera.transform, camera.vertical_fov,
            camera.aspect > 0.0f ? camera.aspect : kFreeAspect, camera.orthographic_height};
}

}  // namespace lumel
