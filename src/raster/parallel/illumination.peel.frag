#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/illumination.glsl"

// Depth peeling of an illumination map: keeps the surface closest to the direction's light among
// those behind the previous pass's.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
uniform usampler2D before;
layout(location = 0) in vec2 place;
layout(location = 0) out uvec2 fragment;

void main()
{
    if (!lies_behind(p, texelFetch(before, ivec2(gl_FragCoord.xy), 0).xy))
        discard;
    fragment = uvec2(surface_at(p, place), floatBitsToUint(gl_FragCoord.z));
}
