#version 460
#include "methods/gather/gather.shared.h"

// One level of the mipmaps of hemicubes, each pixel the mean of four [Hoef13] 4.2, Integration. The
// last level is the mean over the hemicube; times its pixels, it is H.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ReduceParams p; };
layout(scalar) buffer Mipmaps { vec3 mipmaps[]; };
layout(scalar) writeonly buffer LinkSet { vec3 gathered[]; };

void main()
{
    const uint g = gl_GlobalInvocationID.x, pixels = p.side * p.side, k = g / pixels;
    if (k >= p.eyes)
        return;
    const uvec2 pixel = uvec2(g % p.side, g % pixels / p.side);
    vec3 mean = vec3(0.0);
    for (uint q = 0u; q < 4u; ++q) {
        const uvec2 fine = 2u * pixel + uvec2(q & 1u, q >> 1u);
        mean += 0.25 * mipmaps[p.from + 4u * k * pixels + fine.y * 2u * p.side + fine.x];
    }
    mipmaps[p.to + g] = mean;
    if (p.side == 1u)
        gathered[k] = p.whole * mean;
}
