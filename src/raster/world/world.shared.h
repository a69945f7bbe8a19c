#ifndef LUMEL_RASTER_WORLD_WORLD_SHARED_H
#define LUMEL_RASTER_WORLD_WORLD_SHARED_H
#include "atlas/packing/lumel.shared.h"
#include "base/core/dispatch.shared.h"
LUMEL_SHARED_BEGIN

/// An instance's transform to the world, now and before the last move.
struct Placement {
    mat4 now;
    mat4 before;
};

LUMEL_SHARED_END
#endif
