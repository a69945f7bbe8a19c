#version 460
#include "methods/redistribution/paper_cross.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "solve/shooting/radiosity.glsl"

// [Hoef13] Algorithm 4.5, GatherRadiosity, and Algorithm 4.4, lines 13 and 14: the shot light of C
// on the hemicube of a patch of M, weighted by the delta form factors, is R_g(C, M); then the
// patch's whole light counts as shot:
//
//     H_j += Σ_q ΔF_q B_q^s,      B_j^s = E_j + ρ_j H_j
//
// One workgroup per patch.

layout(local_size_x = kPaperGatherGroup) in;
layout(push_constant, scalar) uniform Params { PaperGatherParams p; };
uniform sampler2DMS views;
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer DeltaFormFactors { float delta_form_factor[]; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) buffer Far { vec3 far[]; };
layout(scalar) writeonly buffer Sent { vec3 shot[]; };

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
    if (s.facing < 0.0)  // the side without lumels receives nothing
        return;
    const uvec2 size = uvec2(2u * p.views.side, 3u * p.views.side / 2u);
    const ivec2 corner = ivec2(uvec2(k % p.views.columns, k / p.views.columns) * size);
    vec3 sum = vec3(0.0);
    for (uint q = me; q < size.x * size.y; q += kPaperGatherGroup) {
        const ivec2 pixel = corner + ivec2(q % size.x, q / size.x);
        for (uint n = 0u; n < p.samples; ++n)
            sum += delta_form_factor[q * p.samples + n] * texelFetch(views, pixel, int(n)).rgb;
    }
    sum = add_over_group(sum);
    for (uint j = s.first + me; j < s.first + s.count; j += kPaperGatherGroup) {
        far[j] += sum;
        shot[j] = emission[j] + surface[j].rgb * far[j];
    }
}
