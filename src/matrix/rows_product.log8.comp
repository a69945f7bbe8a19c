#version 460
#include "matrix/log_code.shared.h"
#include "matrix/rows_product.shared.h"
#include "matrix/log_code.glsl"

// Logarithms of 8 bits, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { uint matrix[]; };

const uint kPlanes = 1u;

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

#include "matrix/rows_product.glsl"
