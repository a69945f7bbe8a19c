#version 460
#define PLANES 1u
#include "../bench/papers/matrix_rows.glsl"
#include "../bench/papers/matrix_log_code.glsl"

// Logarithms of 8 bits, [rows][columns].

layout(scalar) readonly buffer Matrix { uint matrix[]; };

vec4 entries(uint word, uint plane)
{
    return from_log_codes(unpackUnorm4x8(word) * kLogCodes, p.log_step, p.log_factor[plane]);
}

mat4 block(uint block_row, uint quad, uint plane)
{
    const uint first = block_row * 4u * p.quads + quad;
    return mat4(entries(matrix[first], plane), entries(matrix[first + p.quads], plane),
                entries(matrix[first + 2u * p.quads], plane),
                entries(matrix[first + 3u * p.quads], plane));
}
