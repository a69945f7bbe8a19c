#version 460
#define PLANES 1u
#include "../bench/papers/matrix_rows.glsl"

// Entries as floats, [rows][columns].

layout(scalar) readonly buffer Matrix { vec4 matrix[]; };

mat4 block(uint block_row, uint quad, uint plane)
{
    const uint first = block_row * 4u * p.quads + quad;
    return mat4(matrix[first], matrix[first + p.quads], matrix[first + 2u * p.quads],
                matrix[first + 3u * p.quads]);
}
