#version 460
#include "methods/progressive/progressive.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/transport/patch_light.glsl"

// Every lumel receives from all patches of a batch at once, [Hoef13] 4.3.2, ReconstructionShader:
//
//     H_i += Σ_k B_k A_k · V · cosθ_i cosθ_k / (π r²)                             Eq. (2.2.8)
//
// The receiving point is fixed for a patch and a lumel, and different for the next patch.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { PatchReceiveParams p; };
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
    for (uint k = 0u; k < p.shots; ++k)
        if (shots[k].count > 0u)
            sum += light_of(k, lumel, i, p.near_radius, p.views);
    far[i] += sum;
}
