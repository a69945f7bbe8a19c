#pragma once
// Hills.

#include "scene/values/scene.h"

namespace lumel::bench {

/// A square of rolling hills, 2 × cells² triangles, with a camera that looks over it.
Scene landscape(int cells);

}  // namespace lumel::bench
