#version 460
#include "methods/progressive/progressive.shared.h"

// Marks the light of a batch as shot.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { TakeParams p; };
layout(scalar) readonly buffer Chosen { ChosenPatch chosen[]; };
layout(scalar) readonly buffer Shots { PatchShot shots[]; };
layout(scalar) readonly buffer Sending { vec3 sending[]; };
layout(scalar) buffer Sent { vec3 shot[]; };

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.batch || chosen[k].chart == kNoPatch)
        return;
    const PatchShot s = shots[k];
    if (chosen[k].index % s.parts != 0u)  // the first point of a lumel represents all
        return;
    const uint send = chosen[k].send;
    for (uint j = s.first; j < s.first + s.count; ++j) {
        const vec3 before = send == kSendTotal ? vec3(0.0) : shot[j];
        shot[j] = send == kSendBack ? vec3(0.0) : before + sending[j] * float(s.parts);
    }
}
