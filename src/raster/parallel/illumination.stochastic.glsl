#ifndef LUMEL_VISIBILITY_ILLUMINATION_STOCHASTIC_GLSL
#define LUMEL_VISIBILITY_ILLUMINATION_STOCHASTIC_GLSL

// Stochastic depths [TN11].

#include "base/core/hash.glsl"
#include "raster/parallel/illumination_maps.shared.h"

// Stored sample of a surface: its nearness, and the slopes of its plane per pixel. Takes
// derivatives, so control flow must be uniform.
uvec4 sample_of(float nearness)
{
    return uvec4(0u, floatBitsToUint(nearness), floatBitsToUint(dFdx(nearness)),
                 floatBitsToUint(dFdy(nearness)));
}

// Random depth of a surface at a pixel, Figure 4: the largest stays. 0 is behind everything.
float random_depth(uvec2 fragment, uint random)
{
    const uvec2 pixel = uvec2(gl_FragCoord.xy);
    const uint here = hash(pixel.x ^ hash(pixel.y ^ hash(fragment.y ^ hash(fragment.x))));
    return 1.0 - unit_float(hash(here ^ random));
}

// Depth for the depth test: random within a region, ordinary beyond it.
float deciding_depth(IlluminationParams p, uvec2 fragment, uint random)
{
    return p.ordinary != 0u ? gl_FragCoord.z : random_depth(fragment, random);
}

#endif
