#version 460
#include "methods/redistribution/cross.shared.h"
#include "atlas/packing/lumel.shared.h"

// Replaces the previous effect of movable patches. Nothing accumulates over moves.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Fresh { vec3 fresh[]; };
layout(scalar) buffer Crossing { vec3 crossing[]; };
layout(scalar) buffer Far { vec3 far[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count || (lumels[i].flags & kLumelMoving) != 0u)
        return;
    far[i] += fresh[i] - crossing[i];
    crossing[i] = fresh[i];
}
