#version 460
#include "solve/shooting/iteration.shared.h"

// One near-field sweep over the finished far light:  X ← ρH (then near_rows.comp), H ← far + near.
// The running averages stay.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Far { vec3 far[]; };
layout(scalar) readonly buffer NearEmission { vec3 near_emission[]; };
layout(scalar) readonly buffer NearSource { vec3 near_source[]; };
layout(scalar) writeonly buffer Irradiance { vec3 irradiance[]; };
layout(scalar) writeonly buffer Source { vec3 source[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const vec3 h = far[i] + near_emission[i] + near_source[i];
    irradiance[i] = h;
    source[i] = surface[i].rgb * h;
}
