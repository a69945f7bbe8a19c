#ifndef LUMEL_TRANSPORT_PATCH_LIGHT_GLSL
#define LUMEL_TRANSPORT_PATCH_LIGHT_GLSL

// Light from a patch at a point. Declares the batch: `eyes`, `shots`, and the radiosity that the
// lumels of its patches send, `sending`. Before including this, POWER_OF(k) and SENDING_OF(k, j)
// can be defined as the light that shot k and its lumel j send to the pair instead.

#include "raster/near/near_pairs.glsl"
#include "solve/shooting/radiosity.glsl"
#include "solve/shooting/receiver.glsl"
#include "solve/transport/patch_shots.shared.h"
#include "raster/world/receiving_point.glsl"

layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Sending { vec3 sending[]; };

#ifndef POWER_OF
#define POWER_OF(k) shots[k].power
#define SENDING_OF(k, j) sending[j]
#endif

// Beyond this multiple of the patch's size, the patch counts as one point.
const float kFar = 4.0;

// [Hoef13] Eq. (2.2.8), with the disc of each lumel where the patch is close (adaptive form factor
// subdivision, section 4.3.3). Near-field pairs are left out, and with them the term A_j: the near
// field holds them exactly.
vec3 light_without_occluders(Receiver r, uint k, float near_radius)
{
    const PatchShot s = shots[k];
    const vec3 d = r.x - eyes[k].position;
    const float near_reach = near_radius * max(r.size, s.lumel_size) + r.size;
    const float reach = kFar * s.size + near_reach;
    if (dot(d, d) >= reach * reach)
        return POWER_OF(k) * point_factor(d, eyes[k].normal, r.normal, 0.0);
    vec3 sum = vec3(0.0);
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const Lumel lumel = lumels[j];
        if (j == r.lumel || is_near(r.centre, r.size, lumel.position, lumel.size, near_radius))
            continue;
        const vec3 from = s.parts > 1u ? eyes[k].position : lumel.position;
        sum += SENDING_OF(k, j) *
               (lumel.area * point_factor(r.x - from, lumel.normal, r.normal, 0.0));
    }
    return sum / kPi;
}

// Light of shot k at its own fixed point of lumel i; the patch's eye decides for all its lumels.
vec3 light_of(uint k, Lumel lumel, uint i, float near_radius, EyeViewLayout tiling)
{
    const LumelPoint x = receiving_point(lumel, i, shots[k].number, 0u, false);
    const Receiver r = receiver_at(x, lumel, i);
    const vec3 light = light_without_occluders(r, k, near_radius);
    return light != vec3(0.0) && is_seen(r, eyes[k], k, tiling) ? light : vec3(0.0);
}

#endif
