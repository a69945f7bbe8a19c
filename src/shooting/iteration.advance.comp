#version 460
#include "shooting/iteration.shared.h"

// The next source from the averaged solution ([BJ04] Eq. (2): T* acts on the running average),
// and, at the end of a phase, this phase's far light (for unit power) folded into that of
// earlier ones.

layout(local_size_x = kIterationGroup) in;
layout(push_constant, scalar) uniform Params { AdvanceParams p; };
layout(binding = 0, scalar) readonly buffer Surface { vec4 surface[]; };  // ρ, A
layout(binding = 1, scalar) readonly buffer Emission { vec3 emission[]; };
layout(binding = 2, scalar) readonly buffer Irradiance { vec3 irradiance[]; };
layout(binding = 3, scalar) readonly buffer Totals { Terms totals[]; };
layout(binding = 4, scalar) buffer Indirect { vec3 indirect[]; };
layout(binding = 5, scalar) buffer Earlier { vec3 earlier[]; };
layout(binding = 6, scalar) writeonly buffer Source { vec3 source[]; };

#include "shooting/iteration.glsl"

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
