#ifndef LUMEL_WORLD_RECEIVING_POINT_GLSL
#define LUMEL_WORLD_RECEIVING_POINT_GLSL

// Points at which lumels receive light.

#include "base/core/hash.glsl"
#include "raster/world/lumel.glsl"

// A point of the lumel per batch: additive recurrence (R2 sequence), with a different start per
// lumel.
LumelPoint receiving_point(Lumel lumel, uint i, uint iteration, uint seed, bool centre)
{
    const uint start = hash(i ^ hash(seed));
    const float s = unit_float(start + iteration * 3242174889u);
    const float t = unit_float(hash(start) + iteration * 2447445414u);
    LumelPoint point = point_on(lumel, s, t);
    if (centre) {
        point.position = lumel.position;
        point.normal = lumel.normal;
    }
    return point;
}

#endif
