#version 460
#include "visibility/lit_views.shared.h"
#include "atlas/lumel.shared.h"
#include "visibility/hemicube.glsl"

// A pixel shows the radiosity of the lumel under it, and its depth.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 1, scalar) readonly buffer LumelOf { uint lumel_of[]; };  // by side and texel
layout(binding = 2, scalar) readonly buffer Radiosity { vec3 radiosity[]; };
layout(location = 0) in vec2 place;
layout(location = 1) flat in vec4 chart;
layout(location = 0) out vec4 color;

#include "visibility/lit.glsl"

void main()
{
    color = vec4(radiosity_at(p, place, chart), gl_FragCoord.z);
}
