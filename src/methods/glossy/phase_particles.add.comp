#version 460
#include "methods/glossy/phase_particles.shared.h"

// Light of lobes into the sums of a batch, with the weight of its shots (phase_particles.cpp).

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { PhaseParticlesParams p; };
layout(scalar) readonly buffer Emission { vec3 emission[]; };  // [N] P* E
layout(scalar) readonly buffer Source { vec3 source[]; };  // [N] P* X
layout(scalar) buffer Direct { vec3 direct[]; };  // [2][N] sums
layout(scalar) buffer Indirect { vec3 indirect[]; };  // [2][N] sums

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    const uint at = p.half_index * p.count + i;
    direct[at] += p.emission_shots * emission[i];
    if (p.source_shots > 0.0)
        indirect[at] += p.source_shots * source[i];
}
