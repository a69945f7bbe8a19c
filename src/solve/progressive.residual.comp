#version 460
#include "solve/progressive.shared.h"
#include "shooting/figures.shared.h"
#include "atlas/lumel.shared.h"
#include "shooting/radiosity.glsl"

// Sums of light: what is still to be shot, what arrived, and what reflects it.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { ResidualParams p; };
layout(binding = 0, scalar) readonly buffer Surface { vec4 surface[]; };
layout(binding = 1, scalar) readonly buffer Emission { vec3 emission[]; };
layout(binding = 2, scalar) readonly buffer Far { vec3 far[]; };
layout(binding = 3, scalar) readonly buffer Near { vec3 near[]; };
layout(binding = 4, scalar) readonly buffer Sent { vec3 shot[]; };
layout(binding = 5, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 6, scalar) writeonly buffer Parts { Terms parts[]; };

#include "shooting/sum.glsl"
#include "transport/unshot.glsl"

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    Terms terms = no_terms();
    if (i < p.count && (lumels[i].flags & kLumelMoving) == 0u) {
        const float area = surface[i].a;
        const vec3 arrived = far[i] + near[i];
        terms.column[0] = area * vec4(abs(luminance(unshot_of(i))), luminance(arrived),
                                      luminance(surface[i].rgb * arrived), 1.0);
    }
    const Terms sum = add_over_group(terms);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = sum;
}
