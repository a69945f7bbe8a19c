#version 460
#include "links/sweeps/sweeps.shared.h"

// Ends a sweep: irradiance, the light that is then sent, and sums over each workgroup. `gathered`
// begins again with the sources.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { SweepReceiveParams p; };
layout(scalar) readonly buffer Albedo { vec3 albedo[]; };
layout(scalar) readonly buffer Source { vec4 source[]; };
layout(scalar) readonly buffer ShareOfRay { float share_of_ray[]; };
layout(scalar) readonly buffer Sent { vec4 sent[]; };
layout(scalar) buffer Gathered { vec4 gathered[]; };
layout(scalar) writeonly buffer Next { vec4 next[]; };
layout(scalar) writeonly buffer Received { vec3 received[]; };
layout(scalar) writeonly buffer Sums { SweepSums sums[]; };

shared SweepSums terms[kGroup];

void main()
{
    const uint part = p.range.first + gl_GlobalInvocationID.x;
    terms[gl_LocalInvocationID.x] = SweepSums(0.0, 0.0, 0u);
    if (part < p.parts) {
        const vec3 mean = mean_light(gathered[part].xyz, share_of_ray[part]);
        const vec3 light = radiosity(albedo[part], mean);
        gathered[part] = source[part];
        received[part] = mean;
        next[part] = vec4(light, 0.0);
        terms[gl_LocalInvocationID.x] = sweep_sums(sent[part].xyz, light, p.darkest);
    }
    barrier();
    if (gl_LocalInvocationID.x == 0u && part < p.parts) {
        SweepSums sum = terms[0];
        for (uint k = 1u; k < kGroup; ++k)
            sum = plus(sum, terms[k]);
        sums[part / kGroup] = sum;
    }
}
