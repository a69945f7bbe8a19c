#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemicube.glsl"

// A vertex projected to one face of an eye's hemicube.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
}
