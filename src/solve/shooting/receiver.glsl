#ifndef LUMEL_SHOOTING_RECEIVER_GLSL
#define LUMEL_SHOOTING_RECEIVER_GLSL

// A receiving point, and its visibility from an eye.

#include "raster/eyes/sees.glsl"
#include "raster/world/lumel.glsl"

struct Receiver {
    vec3 x, normal, facing;  // receiving point
    vec3 centre;             // centre of its lumel
    float size;              // size of its lumel
    uint lumel;
};

Receiver receiver_at(LumelPoint x, Lumel lumel, uint i)
{
    return Receiver(x.position, x.normal, x.facing, lumel.position, lumel.size, i);
}

// True if the eye of the tile sees the front of the receiving point.
bool is_seen(Receiver r, Eye eye, uint tile, EyeViewLayout tiling)
{
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 d = r.x - eye.position;
    const vec3 local = d * frame;
    return local.z > 0.0 && dot(d, r.normal) < 0.0 && sees(tiling, tile, local, r.facing * frame);
}

#endif
