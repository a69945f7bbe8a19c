#ifndef LUMEL_RASTER_WORLD_WORLD_SHARED_H
#define LUMEL_RASTER_WORLD_WORLD_SHARED_H
#include "atlas/packing/lumel.shared.h"
LUMEL_SHARED_BEGIN

LUMEL_CONST uint kPlaceGroup = 64u;  ///< threads per workgroup of world.place_*.comp

/// An instance's transform to the world, now and before the last move.
struct Placement {
    mat4 now;
    mat4 before;
};

/// Push constants of world.place_lumels.comp and world.place_vertices.comp.
struct PlaceParams {
    uint count;  ///< number of lumels or vertices
};

LUMEL_SHARED_END
#endif
