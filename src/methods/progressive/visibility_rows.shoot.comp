#version 460
#include "methods/progressive/visibility_rows.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/transport/patch_light.glsl"
#include "methods/progressive/visibility_rows.glsl"

// Light as in progressive.receive.comp, with stored V: needs no views.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { RowsParams p; };
layout(scalar) buffer Far { vec3 far[]; };

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & (kLumelBuried | kLumelMoving)) != 0u)
        return;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.batch.shots; ++k) {
        const uint row = row_of[p.batch.first_place + k];
        if (shots[k].count == 0u || row == kNoRow || !was_seen(row, i, p.batch.count))
            continue;
        const Receiver r =
            receiver_at(receiving_point(lumel, i, shots[k].number, 0u, false), lumel, i);
        sum += light_without_occluders(r, k, p.batch.near_radius);
    }
    far[i] += p.batch.sign_factor * sum;
}
