#version 460
#define PLANES 1u
#include "../bench/papers/matrix_rows.glsl"
#include "../bench/papers/matrix_log_code.glsl"

// Logarithms in BC4 blocks, [rows / 4][columns / 4].

layout(scalar) readonly buffer Matrix { uvec2 matrix[]; };

// Index 0 and 1 name the ends, 2 to 7 what lies between; or, where the first end is not the larger,
// 2 to 5 do and 6 and 7 are 0 and 255.
vec4 texels(uint bits, float first, float second, uint plane)
{
    const bool six = first > second;
    const uvec4 index = uvec4(bits, bits >> 3, bits >> 6, bits >> 9) & 7u;
    const vec4 between = mix(vec4(first), vec4(second), (vec4(index) - 1.0) / (six ? 7.0 : 5.0));
    const vec4 ends = mix(vec4(first), vec4(second), equal(index, uvec4(1u)));
    vec4 codes = mix(between, ends, lessThan(index, uvec4(2u)));
    if (!six)
        codes = mix(codes, mix(vec4(0.0), vec4(kLogCodes), equal(index, uvec4(7u))),
                    greaterThan(index, uvec4(5u)));
    return from_log_codes(codes, p.log_step, p.log_factor[plane]);
}

// 12 bits for each row, from bit 16 on; the second row crosses into the second word.
mat4 block(uint block_row, uint quad, uint plane)
{
    const uvec2 words = matrix[block_row * p.quads + quad];
    const float first = float(words.x & 255u), second = float(words.x >> 8 & 255u);
    return mat4(texels(words.x >> 16, first, second, plane),
                texels(words.x >> 28 | words.y << 4, first, second, plane),
                texels(words.y >> 8, first, second, plane),
                texels(words.y >> 20, first, second, plane));
}
