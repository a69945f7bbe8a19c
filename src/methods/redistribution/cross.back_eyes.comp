#version 460
#include "methods/redistribution/cross.shared.h"

// Eyes on the backs of patches, opposite to their fronts.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { TakeParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) writeonly buffer BackEyes { Eye back_eyes[]; };

void main()
{
    const uint k = gl_GlobalInvocationID.x;
    if (k >= p.batch)
        return;
    const Eye eye = eyes[k];
    back_eyes[k] = Eye(eye.position, eye.tangent, -eye.bitangent, -eye.normal, eye.random,
                       eye.channel);
}
