#version 460
#include "solve/transport/patch_shots.shared.h"
#include "atlas/packing/lumel.shared.h"

// [Hoef13] Algorithm 4.3, line 6: moved lumels have only the light that they emit, none of it shot.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Moved { uint moved[]; };  // [instances]
layout(scalar) buffer Far { vec3 far[]; };
layout(scalar) writeonly buffer Sent { vec3 shot[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i < p.count && moved[lumels[i].instance] != 0u)
        far[i] = shot[i] = vec3(0.0);
}
