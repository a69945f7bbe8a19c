#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemicube.glsl"

// One vertex as the eye sees it through one face.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
}
