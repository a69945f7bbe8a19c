#version 460
#include "methods/redistribution/cross.shared.h"

// Lumels of movable patches send all their light [Hoef13] 4.5.1: B = E + ρH.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { TakeParams p; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Surface { vec4 surface[]; };
layout(scalar) readonly buffer Emission { vec3 emission[]; };
layout(scalar) readonly buffer Far { vec3 far[]; };
layout(scalar) readonly buffer Near { vec3 near[]; };
layout(scalar) writeonly buffer Sent { vec3 shot[]; };
layout(scalar) writeonly buffer Crossed { vec3 crossed[]; };

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.batch || shots[k].facing < 0.0)
        return;
    for (uint j = shots[k].first; j < shots[k].first + shots[k].count; ++j)
        shot[j] = crossed[j] = emission[j] + surface[j].rgb * (far[j] + near[j]);
}
