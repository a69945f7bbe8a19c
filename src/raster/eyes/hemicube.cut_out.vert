#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemicube.glsl"

// hemicube.vert for surfaces with alpha: passes texture coordinates too.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 look;  // u, v, alpha factor
layout(location = 0) out vec3 look_out;

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
    look_out = look;
}
