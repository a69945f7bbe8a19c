#version 460
#include "raster/eyes/lit_views.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit.glsl"

// Radiosity of the lumel at a pixel, and its depth.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec2 place;
layout(location = 1) flat in vec4 chart;
layout(location = 0) out vec4 color;

void main()
{
    color = vec4(radiosity_at(p, place, chart), gl_FragCoord.z);
}
