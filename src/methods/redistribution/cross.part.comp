#version 460
#include "methods/redistribution/cross.shared.h"

// Light that is crossed: all shot light except that of lamps, which is shot past movable objects.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Sent { vec3 shot[]; };
layout(scalar) readonly buffer IsLamp { uint is_lamp[]; };  // [N]
layout(scalar) writeonly buffer Crossed { vec3 crossed[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i < p.count)
        crossed[i] = is_lamp[i] != 0u ? vec3(0.0) : shot[i];
}
