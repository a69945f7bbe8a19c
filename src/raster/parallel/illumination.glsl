#ifndef LUMEL_VISIBILITY_ILLUMINATION_GLSL
#define LUMEL_VISIBILITY_ILLUMINATION_GLSL

// What a pixel of an illumination map holds.

#include "raster/parallel/illumination_maps.shared.h"

// Which side of which texel a fragment shows. Seen against the direction, fronts go around
// counter-clockwise; in the image, whose y axis points down, they go around clockwise.
uint surface_at(IlluminationParams p, vec2 place)
{
    const uvec2 texel = min(uvec2(max(place, vec2(0.0))), uvec2(p.width, p.height) - 1u);
    return 1u + 2u * (texel.y * p.width + texel.x) + (gl_FrontFacing ? 0u : 1u);
}

// Peeling: is the fragment behind what the pass before kept of the pixel?
bool lies_behind(IlluminationParams p, uvec2 before)
{
    return p.layer == 0u || (before.x != 0u && gl_FragCoord.z < uintBitsToFloat(before.y));
}

#endif
