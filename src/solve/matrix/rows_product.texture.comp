#version 460
#define PLANES 3u
#include "solve/matrix/rows_product.glsl"
#include "solve/matrix/log_code.glsl"

// Logarithms of all channels in a texture of BC1 blocks, decoded by the hardware.

uniform sampler2D matrix;

vec4 entries(uint row, uint quad, uint plane)
{
    vec4 codes;
    for (uint i = 0u; i < 4u; ++i)
        codes[i] = texelFetch(matrix, ivec2(quad * 4u + i, row), 0)[plane];
    return from_log_codes(codes * kLogCodes, p.log_step, p.log_factor[plane]);
}

mat4 block(uint block_row, uint quad, uint plane)
{
    const uint row = block_row * 4u;
    return mat4(entries(row, quad, plane), entries(row + 1u, quad, plane),
                entries(row + 2u, quad, plane), entries(row + 3u, quad, plane));
}
