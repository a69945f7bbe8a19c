#version 460
#include "matrix/log_code.shared.h"
#include "matrix/rows_product.shared.h"
#include "matrix/log_code.glsl"

// Logarithms of 8 bits, [rows][columns].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { uint matrix[]; };

const uint kPlanes = 1u;

vec4 part(uint block_row, uint quad, uint plane, uint r)
{
    const vec4 codes =
        unpackUnorm4x8(matrix[(block_row * 4u + r) * p.quads + quad]) * kLogCodes;
    return from_log_codes(codes, p.log_step, p.log_factor[plane]);
}

#include "matrix/rows_product.glsl"
