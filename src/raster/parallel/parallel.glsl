#ifndef LUMEL_VISIBILITY_PARALLEL_GLSL
#define LUMEL_VISIBILITY_PARALLEL_GLSL

// Projection to parallel views.

#include "raster/parallel/parallel_views.shared.h"

// The corner of a tile of the image [pixels].
uvec2 tile_corner(ParallelLayout tiling, uint tile)
{
    return uvec2(tile % tiling.columns, tile / tiling.columns) * tiling.side;
}

vec2 place_in(ParallelView view, vec3 x)
{
    return vec2(dot(view.right, x), dot(view.up, x)) + view.shift;
}

float nearness_in(ParallelView view, vec3 x)
{
    return dot(view.toward, x) + view.depth_shift;
}

// Clip space of the tile, reversed z.
vec4 through_parallel(ParallelView view, ParallelLayout tiling, vec3 x)
{
    return vec4(place_in(view, x) * (2.0 / float(tiling.side)) - 1.0, nearness_in(view, x), 1.0);
}

#endif
