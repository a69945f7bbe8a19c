#version 460
#include "solve/transport/form_factors.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/transport/patch_light.glsl"

// Irradiance of every lumel from patches of radiosity 1: F_ip without close pairs,
//
//     F_ip = Σ_k A_k V cosθ_i cosθ_k / (π r²)      over the blocks k of patch p,
//
// where V is that of a different point of the lumel for each block, but the distance is that of its
// centre, so that two lumels agree about each other.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { FormFactorParams p; };
layout(scalar) readonly buffer Columns { uint columns[]; };
layout(scalar) buffer Received { float received[]; };

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    for (uint k = 0u; k < p.shots; ++k) {
        const LumelPoint x = receiving_point(lumel, i, shots[k].number, 0u, false);
        Receiver middle = receiver_at(x, lumel, i);
        middle.x = lumel.position;
        middle.normal = lumel.normal;
        const float light = light_without_occluders(middle, k, p.near_radius).x;
        if (light > 0.0 && is_seen(receiver_at(x, lumel, i), eyes[k], k, p.views))
            received[columns[p.first_block + k] * p.lumels + i] += light;
    }
}
