// When a surface with alpha blocks. Needs core/hash.glsl.

// A masked surface is there where alpha reaches the cut-off; a blended one (cutoff < 0) is there
// with probability alpha, so that over many shots it lets 1 - alpha of the light through.
// `depth` tells surfaces apart that lie behind one another in a pixel.
bool blocks(float alpha, float cutoff, vec2 at, float depth, uint random)
{
    if (cutoff >= 0.0)
        return alpha >= cutoff;
    const uvec2 pixel = uvec2(at);
    const uint where = hash(pixel.x ^ hash(pixel.y ^ hash(floatBitsToUint(depth))));
    return alpha > unit_float(hash(where ^ random));
}
