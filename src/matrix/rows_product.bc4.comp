#version 460
#include "matrix/log_code.shared.h"
#include "matrix/rows_product.shared.h"
#include "matrix/log_code.glsl"

// Logarithms in BC4 blocks, [rows / 4][columns / 4].

layout(push_constant, scalar) uniform Params { ProductParams p; };
layout(binding = 0, scalar) readonly buffer Matrix { uvec2 matrix[]; };

const uint kPlanes = 1u;

// Index 0 and 1 name the ends, the others what lies between, from the first to the second.
float texel(uint index, float first, float second)
{
    const bool six = first > second;
    const float steps = six ? 7.0 : 5.0;
    const float between = mix(first, second, (float(index) - 1.0) / steps);
    return index == 0u ? first
                       : (index == 1u ? second
                                      : (!six && index >= 6u ? (index == 6u ? 0.0 : 255.0)
                                                             : between));
}

vec4 part(uint block_row, uint quad, uint plane, uint r)
{
    const uvec2 block = matrix[block_row * p.quads + quad];
    const float first = float(block.x & 255u), second = float(block.x >> 8 & 255u);
    // 12 bits for each row, from bit 16 on; the second row crosses into the second word.
    const uint bits = r == 0u   ? block.x >> 16
                      : r == 1u ? block.x >> 28 | block.y << 4
                                : block.y >> (12u * r - 16u);
    vec4 codes;
    for (uint i = 0u; i < 4u; ++i)
        codes[i] = texel(bits >> (3u * i) & 7u, first, second);
    return from_log_codes(codes, p.log_step, p.log_factor[plane]);
}

#include "matrix/rows_product.glsl"
