#ifndef LUMEL_VISIBILITY_LIT_GLSL
#define LUMEL_VISIBILITY_LIT_GLSL

// Radiosity of a fragment. Declares `lumel_of` and `radiosity`.

#include "atlas/packing/lumel.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit_views.shared.h"

layout(scalar) readonly buffer LumelOf { uint lumel_of[]; };  // by side and texel
layout(scalar) readonly buffer Radiosity { vec3 radiosity[]; };

// Margin inside chart borders, because charts may be adjacent [texels].
const float kBorder = 1.0 / 1024.0;

// B of the lumel at an atlas position [texels]; sides without lumels are black. Positions outside
// the chart, from partially covered pixels, are clamped to its rectangle (low, high).
vec3 radiosity_at(LitParams p, vec2 place, vec4 chart)
{
    const vec2 inside = min(max(place, chart.xy), chart.zw - kBorder);
    const uvec2 texel = min(uvec2(max(inside, vec2(0.0))), uvec2(p.width, p.height) - 1u);
    const uint back = gl_FrontFacing != is_mirrored(p.face) ? 0u : 1u;
    const uint j = lumel_of[2u * (texel.y * p.width + texel.x) + back];
    return j == kNoLumel ? vec3(0.0) : radiosity[j];
}

#endif
