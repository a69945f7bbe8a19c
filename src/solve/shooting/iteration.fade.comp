#version 460
#include "solve/shooting/iteration.shared.h"

// Leaky integration, [TN11] Figure 6: received light decays with every batch.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { FadeParams p; };
layout(scalar) buffer Direct { vec3 direct[]; };  // [2][N] sums
layout(scalar) buffer Indirect { vec3 indirect[]; };  // [2][N] sums

void main()
{
    const uint at = gl_GlobalInvocationID.x;
    if (at >= p.count)
        return;
    direct[at] *= p.kept;
    indirect[at] *= p.kept;
}
