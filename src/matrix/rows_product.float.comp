#version 460
#include "matrix/rows_product.shared.h"

// Entries as floats, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { vec4 matrix[]; };

const uint kPlanes = 1u;

mat4 block(uint block_row, uint quad, uint plane)
{
    const uint first = block_row * 4u * p.quads + quad;
    return mat4(matrix[first], matrix[first + p.quads], matrix[first + 2u * p.quads],
                matrix[first + 3u * p.quads]);
}

#include "matrix/rows_product.glsl"
