#version 460
#include "solve/progressive.shared.h"
#include "shooting/radiosity.glsl"

// Light of each chart [Hoef13] 4.3.2, FindShootingQuad. A workgroup a chart.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { ChooseParams p; };
layout(binding = 0, scalar) readonly buffer Charts { PatchChart charts[]; };
layout(binding = 1, scalar) readonly buffer Surface { vec4 surface[]; };
layout(binding = 2, scalar) readonly buffer Emission { vec3 emission[]; };
layout(binding = 3, scalar) readonly buffer Far { vec3 far[]; };
layout(binding = 4, scalar) readonly buffer Near { vec3 near[]; };
layout(binding = 5, scalar) readonly buffer Sent { vec3 shot[]; };
layout(binding = 6, scalar) readonly buffer Ambient { vec3 ambient; };  // of the batch before
layout(binding = 7, scalar) writeonly buffer Lights { ChartLight lights[]; };

#include "transport/foreseen.glsl"
#include "solve/progressive.chart_light.glsl"

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
