#version 460
#include "solve/shooting/iteration.shared.h"
#include "solve/shooting/iteration.glsl"

// The next source from the averaged solution ([BJ04] Eq. (2): T* acts on the running average). At
// the end of a phase, adds this phase's far light (for unit power) to that of earlier phases.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { AdvanceParams p; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Irradiance { vec3 irradiance[]; };
layout(scalar) buffer Indirect { vec3 indirect[]; };
layout(scalar) buffer Earlier { vec3 earlier[]; };
layout(scalar) writeonly buffer Source { vec3 source[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    if (p.end_phase != 0u)
        for (uint h = 0u; h < 2u; ++h) {
            const uint at = h * p.count + i;
            earlier[at] = far_pattern(p.averages, h, indirect[at], earlier[at]);
            indirect[at] = vec3(0.0);
        }
    source[i] = surface[i].rgb * irradiance[i] + (p.with_emission != 0u ? emission[i] : vec3(0.0));
}
