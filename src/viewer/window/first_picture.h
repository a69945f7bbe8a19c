#pragma once
// Unlit preview, shown until all links are traced.

#include "base/core/image.h"
#include "rays/cast/ray_scene.h"
#include "scene/values/view.h"

namespace lumel {

/// The scene in its surface colours, brightest where surfaces face the eye: one ray per pixel, on
/// the CPU. Display-referred, 3 channels.
Image first_picture(const Scene& scene, const RayScene& rays, const View& view,
                    const glm::ivec2& size);

}  // namespace lumel
