#version 460
#include "methods/redistribution/cross.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/eyes/sees.glsl"
#include "raster/near/near_pairs.glsl"

// Light that arrives at the lumels of movable patches, R_g(C, M) and R(M, M) of [Hoef13] 4.5.1:
//
//     H_m = Σ_i B_i^s A_i · V · cosθ_m cosθ_i / (π r²)
//
// over all lumels i that the patch's hemicube sees, plus the light that lamps shot at them. One
// workgroup per patch.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CrossGatherParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Crossed { vec3 crossed[]; };
layout(scalar) readonly buffer Fresh { vec3 fresh[]; };  // light of lamps on movable lumels
layout(scalar) buffer Far { vec3 far[]; };

vec3 plus(vec3 a, vec3 b)
{
    return a + b;
}

#define SUMMAND vec3
#include "solve/shooting/group_sum.glsl"

void main()
{
    const uint k = gl_WorkGroupID.x, me = gl_LocalInvocationID.x;
    const PatchShot s = shots[k];
    if (s.facing < 0.0)
        return;
    const Eye eye = eyes[k];
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    vec3 mine[kMaxBlock];
    for (uint m = 0u; m < kMaxBlock; ++m)
        mine[m] = vec3(0.0);
    for (uint i = me; i < p.count; i += kPatchGroup) {
        const Lumel from = lumels[i];
        const vec3 d = from.position - eye.position;
        if (crossed[i] == vec3(0.0) || (from.flags & kLumelBuried) != 0u ||
            dot(d, eye.normal) <= 0.0 || dot(d, from.normal) >= 0.0)
            continue;
        if (!sees(p.views, k, d * frame, from.normal * frame))
            continue;
        const vec3 power = crossed[i] * (from.area / kPi);
        for (uint m = 0u; m < s.count; ++m) {
            const Lumel to = lumels[s.first + m];
            if (!is_near(from.position, from.size, to.position, to.size, p.near_radius))
                mine[m] += power * point_factor(to.position - from.position, from.normal,
                                                to.normal, 0.0);
        }
    }
    for (uint m = 0u; m < s.count; ++m) {
        const vec3 sum = add_over_group(mine[m]);
        if (me == 0u)
            far[s.first + m] = sum + fresh[s.first + m];
    }
}
