#version 460
#include "raster/eyes/lit_views.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit.clip.glsl"

// A vertex projected to one face of an eye's hemicube, with its atlas position.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec4 chart;
layout(location = 0) out vec2 place_out;
layout(location = 1) flat out vec4 chart_out;

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
    clip_to_face(gl_Position);
    place_out = place;
    chart_out = chart;
}
