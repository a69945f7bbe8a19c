#version 460
#include "raster/eyes/lit_views.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit.glsl"

// lit.frag for surfaces with alpha. Absorbing glass is black.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
uniform sampler2D base_color;
layout(location = 0) in vec2 place;
layout(location = 1) flat in vec4 chart;
layout(location = 2) in vec3 look;
layout(location = 0) out vec4 color;

void main()
{
    const Eye eye = eyes[p.eye];
    const Meeting met = meet(p.passage, base_color, look, eye.channel, gl_FragCoord.xy,
                             gl_FragCoord.z, eye.random);
    if (!met.blocked)
        discard;
    color = vec4(met.there ? radiosity_at(p, place, chart) : vec3(0.0), gl_FragCoord.z);
}
