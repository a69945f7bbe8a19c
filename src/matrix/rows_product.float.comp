#version 460
#include "matrix/rows_product.shared.h"

// Entries as floats, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { vec4 matrix[]; };

const uint kPlanes = 1u;

vec4 part(uint block_row, uint quad, uint plane, uint r)
{
    return matrix[(block_row * 4u + r) * p.quads + quad];
}

#include "matrix/rows_product.glsl"
