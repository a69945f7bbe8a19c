#version 460
#include "links/sweeps/sweeps.shared.h"

// Multiplies the light that sub-lumels send by the factors of their groups.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { SweepCorrectParams p; };
layout(scalar) readonly buffer GroupOfPart { uint group_of_part[]; };
layout(scalar) readonly buffer Factors { vec4 factors[]; };
layout(scalar) buffer Next { vec4 next[]; };

void main()
{
    const uint part = p.range.first + gl_GlobalInvocationID.x;
    if (part < p.parts)
        next[part] *= factors[group_of_part[part]];
}
