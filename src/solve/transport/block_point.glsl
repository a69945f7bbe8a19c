#ifndef LUMEL_TRANSPORT_BLOCK_POINT_GLSL
#define LUMEL_TRANSPORT_BLOCK_POINT_GLSL

// Viewpoint of a block of lumels.

#include "solve/transport/patches.shared.h"
#include "raster/world/lumel.glsl"

LumelPoint block_point(Patch block)
{
    if (block.eye != kFromMean) {
        const Lumel lumel = lumels[block.eye];
        return LumelPoint(lumel.position, lumel.normal, lumel.normal, 0u);
    }
    vec3 position = vec3(0.0), normal = vec3(0.0);
    for (uint j = block.first; j < block.first + block.count; ++j) {
        position += lumels[j].position;
        normal += lumels[j].normal;
    }
    return LumelPoint(position / float(block.count), normalize(normal), normal, 0u);
}

#endif
