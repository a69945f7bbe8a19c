#ifndef LUMEL_VISIBILITY_ILLUMINATION_GLSL
#define LUMEL_VISIBILITY_ILLUMINATION_GLSL

// Contents of a pixel of an illumination map.

#include "raster/parallel/illumination_maps.shared.h"

// Side and texel of a fragment. Fronts, seen against the direction, are counter-clockwise; in the
// image, whose y axis points down, they are clockwise.
uint surface_at(IlluminationParams p, vec2 place)
{
    const uvec2 texel = min(uvec2(max(place, vec2(0.0))), uvec2(p.width, p.height) - 1u);
    return 1u + 2u * (texel.y * p.width + texel.x) + (gl_FrontFacing ? 0u : 1u);
}

// Peeling: true if the fragment is behind the one that the previous pass kept.
bool lies_behind(IlluminationParams p, uvec2 before)
{
    return p.layer == 0u || (before.x != 0u && gl_FragCoord.z < uintBitsToFloat(before.y));
}

#endif
