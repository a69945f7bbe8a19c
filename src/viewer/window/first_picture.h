#pragma once
// What there is to see before there is light.

#include "base/core/image.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/view.h"

namespace lumel {

/// The scene in the colours of its surfaces, brightest where they face the eye: by a ray for each
/// pixel, on the host. Display-referred, 3 channels.
Image first_picture(const Scene& scene, const RayScene& rays, const View& view,
                    const glm::ivec2& size);

}  // namespace lumel
