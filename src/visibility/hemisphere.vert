#version 460
#include "visibility/eye_views.shared.h"

// One vertex, in the world and in the eye's frame.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 0) out vec3 world;
layout(location = 1) out vec3 local;

void main()
{
    const Eye eye = eyes[p.eye];
    world = position;
    local = (position - eye.position) * mat3(eye.tangent, eye.bitangent, eye.normal);
}
