#version 460
#define PLANES 3u
#include "../bench/papers/matrix_rows.glsl"
#include "../bench/papers/matrix_log_code.glsl"

// Logarithms of all channels in BC1 blocks, [rows / 4][columns / 4], decoded here.

layout(scalar) readonly buffer Matrix { uvec2 matrix[]; };

// One channel of a colour of 5, 6 and 5 bits, the upper bits repeated below the last.
float channel_of(uint color, uint plane)
{
    if (plane == 1u) {
        const uint green = color >> 5 & 63u;
        return float(green << 2 | green >> 4);
    }
    const uint code = (plane == 0u ? color >> 11 : color) & 31u;
    return float(code << 3 | code >> 2);
}

vec4 texels(uint bits, vec4 palette)
{
    const uvec4 index = uvec4(bits, bits >> 2, bits >> 4, bits >> 6) & 3u;
    return mix(mix(vec4(palette.x), vec4(palette.y), equal(index, uvec4(1u))),
               mix(vec4(palette.z), vec4(palette.w), equal(index, uvec4(3u))),
               greaterThan(index, uvec4(1u)));
}

// The four entries that a block can have are decoded once, then chosen from.
mat4 block(uint block_row, uint quad, uint plane)
{
    const uvec2 words = matrix[block_row * p.quads + quad];
    const uint first = words.x & 0xffffu, second = words.x >> 16;
    const float a = channel_of(first, plane), b = channel_of(second, plane);
    const vec4 codes = first > second ? vec4(a, b, (2.0 * a + b) / 3.0, (a + 2.0 * b) / 3.0)
                                      : vec4(a, b, 0.5 * (a + b), 0.0);
    const vec4 palette = from_log_codes(codes, p.log_step, p.log_factor[plane]);
    return mat4(texels(words.y, palette), texels(words.y >> 8, palette),
                texels(words.y >> 16, palette), texels(words.y >> 24, palette));
}
