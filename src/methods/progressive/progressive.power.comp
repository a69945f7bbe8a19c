#version 460
#include "methods/progressive/progressive.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "solve/transport/foreseen.glsl"

// Light of each chart, one workgroup per chart [Hoef13] 4.3.2, FindShootingQuad.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { ChooseParams p; };
layout(scalar) readonly buffer Charts { PatchChart charts[]; };
layout(scalar) writeonly buffer Lights { ChartLight lights[]; };

#include "methods/progressive/progressive.chart_light.glsl"

void main()
{
    const uint me = gl_LocalInvocationID.x;
    const PatchChart chart = charts[gl_WorkGroupID.x];
    ChartLight mine = no_light();
    for (uint i = me; chart.moving == 0u && i < chart.lumel_count;
         i += kPatchGroup) {
        const uint j = chart.first_lumel + i;
        const vec4 s = surface[j];
        const vec3 arrived = far[j] + near[j], unshot = unshot_of(j);
        mine = plus(mine, ChartLight(s.a * abs(luminance(foreseen(j))), s.a * unshot,
                                     s.a * shot[j], s.a * arrived, s.a * s.rgb * arrived));
    }
    const ChartLight sum = add_over_group(mine);
    if (me == 0u)
        lights[gl_WorkGroupID.x] = sum;
}
