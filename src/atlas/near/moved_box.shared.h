#ifndef LUMEL_ATLAS_NEAR_MOVED_BOX_SHARED_H
#define LUMEL_ATLAS_NEAR_MOVED_BOX_SHARED_H
#include "base/core/shared.h"
LUMEL_SHARED_BEGIN

/// Where something was before it moved, or is now.
struct MovedBox {
    vec3 low;  ///< corners [m], world
    vec3 high;
};

LUMEL_SHARED_END
#endif
