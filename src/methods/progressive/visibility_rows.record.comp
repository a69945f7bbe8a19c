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

// Stores V of all lumels for the patches of a batch.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { RowsParams p; };

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    for (uint k = 0u; k < p.batch.shots; ++k) {
        const uint row = row_of[p.batch.first_place + k];
        if (row == kNoRow)
            continue;
        const Receiver r =
            receiver_at(receiving_point(lumel, i, shots[k].number, 0u, false), lumel, i);
        keep_seen(row, i, p.batch.count, is_seen(r, eyes[k], k, p.batch.views));
    }
}
