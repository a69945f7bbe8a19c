#version 460
#include "visibility/hemicube.shared.h"
#include "visibility/hemicube.glsl"

// hemicube.vert for surfaces with alpha: also hands on where the texture is read.

layout(push_constant, scalar) uniform Params { HemicubeParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 look_in;  // u, v, alpha factor
layout(location = 0) out vec3 look;

void main()
{
    const Eye eye = eyes[p.eye];
    const Face face = hemicube_face(eye, p.face);
    const vec3 d = position - eye.position;
    const float w = dot(d, face.axis);
    const float up = dot(d, face.up);
    gl_Position = vec4(dot(d, face.right), p.face == 0u ? up : 2.0 * up - w, p.near, w);
    look = look_in;
}
