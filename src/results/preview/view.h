#pragma once
// Chooses a view of the scene.

#include "rays/cast/ray_scene.h"
#include "scene/values/scene.h"
#include "scene/values/view.h"

namespace lumel {

/// The scene's first camera, or one that shows most of it: inside a room, or in front of an object.
View choose_view(const Scene& scene, const RayScene& rays);

}  // namespace lumel
