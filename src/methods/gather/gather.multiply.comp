#version 460
#include "methods/gather/gather.shared.h"
#include "raster/eyes/hemicube.glsl"

// Light on hemicubes times the delta form factors [Hoef13] Algorithm 4.1: level 0 of their mipmaps,
// a square with 0 beside the tile.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { MultiplyParams p; };
uniform sampler2DMS views;
layout(scalar) readonly buffer Points { GatheringPoint points[]; };
layout(scalar) readonly buffer DeltaFormFactors { float delta_form_factor[]; };
layout(scalar) writeonly buffer Mipmaps { vec3 mipmaps[]; };

void main()
{
    const uint g = gl_GlobalInvocationID.x, pixels = p.side * p.side, k = g / pixels;
    if (k >= p.eyes)
        return;
    const GatheringPoint point = points[k];
    const uvec2 size = uvec2(2u * p.views.side, 3u * p.views.side / 2u);
    const uvec2 pixel = uvec2(g % p.side, g % pixels / p.side);
    const ivec2 corner = ivec2(uvec2(k % p.views.columns, k / p.views.columns) * size);
    const bool is_inside = all(lessThan(pixel, size));
    vec3 sum = vec3(0.0);
    if (is_inside && (point.tilted == 0u || dot(point.facing, ray_to(p.views.side, pixel)) > 0.0))
        for (uint s = 0u; s < p.samples; ++s)
            sum += delta_form_factor[(pixel.y * size.x + pixel.x) * p.samples + s] *
                   texelFetch(views, corner + ivec2(pixel), int(s)).rgb;
    mipmaps[g] = sum;
}
