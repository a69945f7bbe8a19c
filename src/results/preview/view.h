#pragma once
// A view that shows what a scene is.

#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"
#include "scene/values/view.h"

namespace lumel {

/// The scene's first camera, or one chosen to show most of what is there: inside of a room,
/// before an object.
View choose_view(const Scene& scene, const RayScene& rays);

}  // namespace lumel
