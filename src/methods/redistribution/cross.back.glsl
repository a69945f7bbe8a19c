#ifndef LUMEL_REDISTRIBUTION_CROSS_BACK_GLSL
#define LUMEL_REDISTRIBUTION_CROSS_BACK_GLSL

// Pixel addresses of back hemicubes.

#include "methods/redistribution/cross.shared.h"

uint back_side(BackLayout b, uint level)
{
    return b.side >> level;
}

// First pixel of a hemicube's level.
uint back_start(BackLayout b, uint hemicube, uint level)
{
    uint start = hemicube * b.per_hemicube;
    for (uint l = 0u; l < level; ++l)
        start += 3u * back_side(b, l) * back_side(b, l);
    return start;
}

// Pixel of a tile that is 2 side wide and 3/2 side high.
uint back_pixel(BackLayout b, uint hemicube, uint level, uvec2 pixel)
{
    return back_start(b, hemicube, level) + pixel.y * 2u * back_side(b, level) + pixel.x;
}

#endif
