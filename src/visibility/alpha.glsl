// When a surface with alpha, or of glass, blocks. Needs core/hash.glsl and world/passage.shared.h.

struct Opacity {
    float there;    // share of the light that meets the surface
    float blocked;  // the same and what glass absorbs
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

// A number in 0…1 for a surface at a pixel: over many shots, a surface that blocks where it is less
// than a share of the light blocks that share. `depth` tells surfaces apart that lie behind one
// another.
float chance_at(vec2 at, float depth, uint random)
{
    const uvec2 pixel = uvec2(at);
    const uint where = hash(pixel.x ^ hash(pixel.y ^ hash(floatBitsToUint(depth))));
    return unit_float(hash(where ^ random));
}
