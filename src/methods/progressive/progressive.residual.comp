#version 460
#include "methods/progressive/progressive.shared.h"
#include "solve/shooting/lumel_sums.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "solve/shooting/radiosity.glsl"
#include "solve/transport/unshot.glsl"

// Sums of unshot light, arrived light, and light reflected.

layout(local_size_x = kSumGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) writeonly buffer Parts { Terms parts[]; };

#include "solve/shooting/sum.glsl"

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
    const Terms sum = add_over_group(terms, 1u);
    if (gl_LocalInvocationID.x == 0u)
        parts[gl_WorkGroupID.x] = sum;
}
