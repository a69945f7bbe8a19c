#version 460
#include "visibility/eye_views.shared.h"
#include "core/hash.glsl"
#include "visibility/alpha.glsl"

// A pixel of a surface with alpha, as a hemicube shows it.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
uniform sampler2D base_color;
layout(location = 0) in vec3 look;

void main()
{
    const Eye eye = eyes[p.eye];
    const Meeting met = meet(p.passage, base_color, look, eye.channel, gl_FragCoord.xy,
                             gl_FragCoord.z, eye.random);
    if (!met.blocked)
        discard;
}
