// Parallel views: where points fall.

// The corner of a tile of the image [pixels].
uvec2 tile_corner(ParallelLayout layout_, uint tile)
{
    return uvec2(tile % layout_.columns, tile / layout_.columns) * layout_.side;
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
vec4 through_parallel(ParallelView view, ParallelLayout layout_, vec3 x)
{
    return vec4(place_in(view, x) * (2.0 / float(layout_.side)) - 1.0, nearness_in(view, x), 1.0);
}
