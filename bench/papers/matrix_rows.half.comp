#version 460
#define PLANES 1u
#include "../bench/papers/matrix_rows.glsl"

// Entries as half floats, [rows][columns].

layout(scalar) readonly buffer Matrix { uvec2 matrix[]; };

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
