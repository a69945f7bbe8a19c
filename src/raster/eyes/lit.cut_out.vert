#version 460
#include "raster/eyes/lit_views.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit.clip.glsl"

// lit.vert for surfaces with alpha: passes texture coordinates too.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 2) in vec4 chart;
layout(location = 3) in vec3 look;  // u, v, alpha factor
layout(location = 0) out vec2 place_out;
layout(location = 1) flat out vec4 chart_out;
layout(location = 2) out vec3 look_out;

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
    clip_to_face(gl_Position);
    place_out = place;
    chart_out = chart;
    look_out = look;
}
