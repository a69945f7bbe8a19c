#version 460
#include "transport/form_factors.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"
#include "shooting/radiosity.glsl"

// What every lumel receives of patches whose radiosity is 1: F_ip but for close pairs,
//
//     F_ip = Σ_k A_k V cosθ_i cosθ_k / (π r²)      over the blocks k of patch p,
//
// seen or not from a point of the lumel that is another for each block, but as far away as its
// middle: what two lumels find of each other then agrees.

layout(local_size_x = kFormFactorGroup) in;
layout(push_constant, scalar) uniform Params { FormFactorParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 3, scalar) readonly buffer Shots { PatchShot shots[]; };
layout(binding = 4) uniform sampler2D views;
layout(binding = 5, scalar) readonly buffer Sending { vec3 sending[]; };
layout(binding = 6, scalar) readonly buffer Columns { uint columns[]; };
layout(binding = 7, scalar) buffer Received { float received[]; };

#include "world/lumel.glsl"
#include "world/receiving_point.glsl"
#include "visibility/sees.glsl"
#include "transport/patch_light.glsl"

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
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
        if (light > 0.0 && is_seen(receiver_at(x, lumel, i), k, p.views))
            received[columns[p.first_block + k] * p.lumels + i] += light;
    }
}
