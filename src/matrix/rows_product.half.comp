#version 460
#include "matrix/rows_product.shared.h"

// Entries as half floats, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { uvec2 matrix[]; };

const uint kPlanes = 1u;

vec4 part(uint block_row, uint quad, uint plane, uint r)
{
    const uvec2 words = matrix[(block_row * 4u + r) * p.quads + quad];
    return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y)) * p.factor[plane];
}

#include "matrix/rows_product.glsl"
