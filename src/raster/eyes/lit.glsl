#ifndef LUMEL_VISIBILITY_LIT_GLSL
#define LUMEL_VISIBILITY_LIT_GLSL

// The radiosity that a fragment shows. Declares `lumel_of` and `radiosity`.

#include "atlas/packing/lumel.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/lit_views.shared.h"

layout(scalar) readonly buffer LumelOf { uint lumel_of[]; };  // by side and texel
layout(scalar) readonly buffer Radiosity { vec3 radiosity[]; };

// Charts may lie side by side: this much of their borders is left to neither [texels].
const float kBorder = 1.0 / 1024.0;

// B of the lumel at a place of the atlas [texels]; sides without lumels are black. A pixel of which
// a surface covers only some samples refers to a place beyond the surface's edge: it gets the
// nearest of its chart, whose rectangle has the corners (low, high).
vec3 radiosity_at(LitParams p, vec2 place, vec4 chart)
{
    const vec2 inside = min(max(place, chart.xy), chart.zw - kBorder);
    const uvec2 texel = min(uvec2(max(inside, vec2(0.0))), uvec2(p.width, p.height) - 1u);
    const uint back = gl_FrontFacing != is_mirrored(p.face) ? 0u : 1u;
    const uint j = lumel_of[2u * (texel.y * p.width + texel.x) + back];
    return j == kNoLumel ? vec3(0.0) : radiosity[j];
}

#endif
