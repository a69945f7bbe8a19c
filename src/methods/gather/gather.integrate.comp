#version 460
#include "methods/gather/gather.shared.h"
#include "raster/eyes/hemicube.glsl"

// Sums the light on hemicubes, weighted by the delta form factors [Hoef13] Algorithm 4.1:
//
//     H = Σ_q ΔF_q B_q                                                            [CG85]
//
// over the samples q of all pixels. A workgroup sums one hemicube, in a fixed order.

layout(local_size_x = kIntegrateGroup) in;
layout(push_constant, scalar) uniform Params { IntegrateParams p; };
uniform sampler2DMS views;
layout(scalar) readonly buffer Points { GatheringPoint points[]; };
layout(scalar) readonly buffer DeltaFormFactors { float delta_form_factor[]; };
layout(scalar) writeonly buffer LinkSet { vec3 gathered[]; };

vec3 plus(vec3 a, vec3 b)
{
    return a + b;
}

#define SUMMAND vec3
#include "solve/shooting/group_sum.glsl"

void main()
{
    const uint k = gl_WorkGroupID.x, me = gl_LocalInvocationID.x;
    const GatheringPoint point = points[k];
    const uvec2 size = uvec2(2u * p.views.side, 3u * p.views.side / 2u);
    const ivec2 corner = ivec2(uvec2(k % p.views.columns, k / p.views.columns) * size);
    vec3 sum = vec3(0.0);
    for (uint q = me; q < size.x * size.y; q += kIntegrateGroup) {
        const uvec2 pixel = uvec2(q % size.x, q / size.x);
        if (point.tilted != 0u && dot(point.facing, ray_to(p.views.side, pixel)) <= 0.0)
            continue;
        for (uint s = 0u; s < p.samples; ++s)
            sum += delta_form_factor[q * p.samples + s] *
                   texelFetch(views, corner + ivec2(pixel), int(s)).rgb;
    }
    sum = add_over_group(sum);
    if (me == 0u)
        gathered[k] = sum;
}
