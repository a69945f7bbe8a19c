#ifndef LUMEL_VISIBILITY_ALPHA_GLSL
#define LUMEL_VISIBILITY_ALPHA_GLSL

// Opacity of surfaces with alpha and of glass.

#include "base/core/hash.glsl"
#include "raster/world/passage.shared.h"

// Interaction of a view's light with a surface.
struct Meeting {
    bool there;    // hits the surface
    bool blocked;  // hits it, or is absorbed by glass
};

struct Opacity {
    float there;    // share of the light that hits the surface
    float blocked;  // including the share absorbed by glass
};

// `base`: the texture's colour, and the surface's alpha.
Opacity opacity_of(Passage passage, vec4 base, uint channel)
{
    const float there = passage.cutoff >= 0.0 ? float(base.a >= passage.cutoff) : base.a;
    const vec3 color = passage.color * base.rgb;
    const float tint =
        channel == kAllChannels ? (color.r + color.g + color.b) / 3.0 : color[channel - 1u];
    return Opacity(there * (1.0 - passage.transmission),
                   there * (1.0 - passage.transmission * tint));
}

// Random number in 0…1 for a surface at a pixel: over many shots, a surface that blocks if it is
// less than a share blocks this share of the light. `depth` distinguishes overlapping surfaces.
float chance_at(vec2 at, float depth, uint random)
{
    const uvec2 pixel = uvec2(at);
    const uint where = hash(pixel.x ^ hash(pixel.y ^ hash(floatBitsToUint(depth))));
    return unit_float(hash(where ^ random));
}

// `look`: texture coordinates of the base colour, and the factor of its alpha. `at` [pixels].
Meeting meet(Passage passage, sampler2D base_color, vec3 look, uint channel, vec2 at, float depth,
             uint random)
{
    const vec4 base = textureLod(base_color, look.xy, 0.0) * vec4(vec3(1.0), look.z);
    const Opacity opacity = opacity_of(passage, base, channel);
    const float chance = chance_at(at, depth, random);
    return Meeting(chance < opacity.there, chance < opacity.blocked);
}

#endif
