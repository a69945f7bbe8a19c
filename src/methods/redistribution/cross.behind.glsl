#ifndef LUMEL_METHODS_REDISTRIBUTION_CROSS_BEHIND_GLSL
#define LUMEL_METHODS_REDISTRIBUTION_CROSS_BEHIND_GLSL

// Depth and light of back hemicubes by direction. Declares their pixels.

#include "methods/redistribution/cross.back.glsl"
#include "raster/eyes/hemicube.glsl"
#include "raster/eyes/pixels.glsl"

layout(scalar) readonly buffer Back { BackPixel back[]; };

ViewPoint point_in(uint side, vec3 direction)
{
    return project_to_hemicube(EyeViewLayout(side, 1u, 1.0), direction);
}

// 1 / distance at the pixel of a back hemicube in a direction (t, b, n of the back eye; n ≥ 0).
float inverse_behind(BackLayout b, uint k, vec3 direction)
{
    const ViewPoint f = point_in(b.side, direction);
    return back[back_pixel(b, k, 0u, uvec2(face_corner(b.side, f) + f.pixel))].inverse;
}

// Light in that direction, filtered over the four nearest pixels of a level, but not across the
// edges of faces [Hoef13] 4.5.2.
vec3 level_behind(BackLayout b, uint k, uint level, vec3 direction)
{
    const uint side = back_side(b, level);
    const ViewPoint f = point_in(side, direction);
    const vec2 size = vec2(float(side), f.front ? float(side) : 0.5 * float(side));
    const vec2 at = clamp(f.at - 0.5, vec2(0.0), size - 1.0);
    const vec2 low = floor(at), part = at - low, corner = face_corner(side, f);
    vec3 sum = vec3(0.0);
    for (uint q = 0u; q < 4u; ++q) {
        const vec2 step = vec2(q & 1u, q >> 1u);
        const vec2 weight = mix(1.0 - part, part, step);
        const uvec2 pixel = uvec2(corner + min(low + step, size - 1.0));
        sum += weight.x * weight.y * back[back_pixel(b, k, level, pixel)].shot;
    }
    return sum;
}

#endif
