#version 460
#include "methods/redistribution/cross.shared.h"
#include "raster/eyes/hemicube.glsl"
#include "methods/redistribution/cross.back.glsl"

// Back hemicubes with their mipmaps, [Hoef13] 4.5.2: level 0 is the mean of each pixel's samples,
// other levels that of four pixels. Faces start at even pixels: no pixel mixes two of them.

layout(local_size_x = kPatchGroup) in;
layout(push_constant, scalar) uniform Params { ResolveParams p; };
uniform sampler2DMS views;
layout(scalar) buffer Back { BackPixel back[]; };

BackPixel drawn_at(uint k, uvec2 pixel)
{
    const uvec2 size = uvec2(2u * p.views.side, 3u * p.views.side / 2u);
    const ivec2 at = ivec2(uvec2(k % p.views.columns, k / p.views.columns) * size + pixel);
    vec4 sum = vec4(0.0);
    for (int s = 0; s < int(p.samples); ++s)
        sum += texelFetch(views, at, s);
    // The image stores near / distance along the face's axis.
    const float along_axis = p.views.near * length(ray_to(p.views.side, pixel));
    return BackPixel(sum.rgb / float(p.samples), sum.a / (float(p.samples) * along_axis));
}

BackPixel mean_of_four(uint k, uvec2 pixel)
{
    BackPixel sum = BackPixel(vec3(0.0), 0.0);
    for (uint q = 0u; q < 4u; ++q) {
        const BackPixel one =
            back[back_pixel(p.back, k, p.level - 1u, 2u * pixel + uvec2(q & 1u, q >> 1u))];
        sum.shot += 0.25 * one.shot;
        sum.inverse += 0.25 * one.inverse;
    }
    return sum;
}

void main()
{
    const uint side = back_side(p.back, p.level), pixels = 3u * side * side;
    const uint k = gl_GlobalInvocationID.x / pixels, q = gl_GlobalInvocationID.x % pixels;
    if (k >= p.batch)
        return;
    const uvec2 pixel = uvec2(q % (2u * side), q / (2u * side));
    if (p.level == 0u)
        back[back_pixel(p.back, k, 0u, pixel)] = drawn_at(k, pixel);
    else
        back[back_pixel(p.back, k, p.level, pixel)] = mean_of_four(k, pixel);
}
