#version 460
#include "raster/eyes/eye_views.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"

// Hemicube pixel of a surface with alpha.

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
