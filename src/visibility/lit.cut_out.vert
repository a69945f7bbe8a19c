#version 460
#include "visibility/lit_views.shared.h"
#include "visibility/hemicube.glsl"

// lit.vert for surfaces with alpha: also hands on where the texture is read.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place_in_;
layout(location = 2) in vec4 chart_in;
layout(location = 3) in vec3 look_in;  // u, v, alpha factor
layout(location = 0) out vec2 place;
layout(location = 1) flat out vec4 chart;
layout(location = 2) out vec3 look;

#include "visibility/lit.clip.glsl"

void main()
{
    gl_Position = through_face(eyes[p.eye], p.face, p.near, position);
    clip_to_face(gl_Position);
    place = place_in_;
    chart = chart_in;
    look = look_in;
}
