#version 460
#include "matrix/rows_product.shared.h"

// Entries as half floats, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { uvec2 matrix[]; };

const uint kPlanes = 1u;

vec4 floats(uvec2 words)
{
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y));
}

mat4 block(uint block_row, uint quad, uint plane)
{
    const uint first = block_row * 4u * p.quads + quad;
    return p.factor[plane] *
           mat4(floats(matrix[first]), floats(matrix[first + p.quads]),
                floats(matrix[first + 2u * p.quads]), floats(matrix[first + 3u * p.quads]));
}

#include "matrix/rows_product.glsl"
