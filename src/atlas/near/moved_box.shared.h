#ifndef LUMEL_ATLAS_NEAR_MOVED_BOX_SHARED_H
#define LUMEL_ATLAS_NEAR_MOVED_BOX_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Bounds of a moved object, before or after.
struct MovedBox {
    vec3 low;  ///< bounding box [m], world
    vec3 high;
};

LUMEL_SHARED_END
#endif
