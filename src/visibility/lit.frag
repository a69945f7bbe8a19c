#version 460
#include "visibility/lit_views.shared.h"
#include "atlas/lumel.shared.h"
#include "visibility/hemicube.glsl"

// A pixel shows the radiosity of the lumel under it, and its depth. Places are read where the
// surface covers the pixel: beyond its edge lie texels of others.

layout(push_constant, scalar) uniform Params { LitParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(binding = 1, scalar) readonly buffer LumelOf { uint lumel_of[]; };  // by side and texel
layout(binding = 2, scalar) readonly buffer Radiosity { vec3 radiosity[]; };
layout(location = 0) centroid in vec2 place;
layout(location = 0) out vec4 color;

#include "visibility/lit.glsl"

void main()
{
    color = vec4(radiosity_at(p, place), gl_FragCoord.z);
}
