#version 460
#include "methods/redistribution/incremental.shared.h"
#include "atlas/packing/lumel.shared.h"

// Clears the light of moved lumels: it is shot again [Hoef13] 4.4.1.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Moved { uint moved[]; };  // [instances]
layout(scalar) buffer Far { vec3 far[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i < p.count && moved[lumels[i].instance] != 0u)
        far[i] = vec3(0.0);
}
