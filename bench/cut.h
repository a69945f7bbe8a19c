#pragma once
// The same surfaces in more triangles.

#include "scene/values/scene.h"

namespace lumel::bench {

/// Cuts every triangle into pieces² equal ones. Normals are left out.
Scene cut(Scene scene, int pieces);

}  // namespace lumel::bench
