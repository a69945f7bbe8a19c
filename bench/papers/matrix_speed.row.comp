#version 460
#include "../bench/papers/matrix_speed.shared.h"

// The plain multiply: a group for each row, whose lanes take turns in its columns.

layout(local_size_x = kRowLanes) in;
layout(push_constant, scalar) uniform Params { RowParams p; };
layout(scalar) readonly buffer Matrix { vec4 matrix[]; };
layout(scalar) readonly buffer Vectors { vec4 vectors[]; };
layout(scalar) writeonly buffer Result { float result[]; };

shared float sums[kRowLanes];

void main()
{
    const uint lane = gl_LocalInvocationID.x, row = gl_WorkGroupID.x;
    const uint plane = (p.first_row + row) / p.plane_rows;
    float sum = 0.0;
    for (uint quad = lane; quad < p.quads; quad += kRowLanes)
        sum += dot(matrix[row * p.quads + quad], vectors[plane * p.quads + quad]);
    sums[lane] = sum;
    for (uint width = kRowLanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            sums[lane] += sums[lane + width];
    }
    if (lane == 0u)
        result[p.first_row + row] = sums[0];
}
