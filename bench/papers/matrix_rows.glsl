#ifndef LUMEL_MATRIX_ROWS_GLSL
#define LUMEL_MATRIX_ROWS_GLSL

// result ← matrix vectors. A group has 8 rows; what a lane reads of the vectors serves all of them.
// Each team of lanes goes through a strip of columns of its own, so that memory is read in order,
// a line or more at a time. Sums end in an order that never changes.
//
// Its argument is the macro PLANES, how many planes a block holds. Declares the parameters `p` and
// `block`, which whoever includes this defines.

#include "../bench/papers/matrix_rows.shared.h"

#ifndef PLANES
#error "matrix_rows.glsl: define PLANES"
#endif

layout(push_constant, scalar) uniform Params { ProductParams p; };

// Four rows' entries in columns 4 quad … + 3 (of this part of the matrix), a row in each column of
// the mat4, so that x · block is their dot products with x.
mat4 block(uint block_row, uint quad, uint plane);

layout(constant_id = 0) const uint kVectors = 1u;
const uint kSums = PLANES * kVectors;  // of a row

layout(local_size_x = kProductLanes) in;
layout(scalar) readonly buffer Vectors { vec4 vectors[]; };
layout(scalar) writeonly buffer Result { float result[]; };

const uint kBlocks = kProductRows / 4u;

shared vec4 sums[kSums * kBlocks][kProductLanes];

uint vector_of(uint v, uint plane)
{
    return p.first_vector + v * p.vector_step + plane * p.plane_step;
}

void main()
{
    const uint lane = gl_LocalInvocationID.x;
    const uint row = gl_WorkGroupID.x * kProductRows;
    const uint first_plane = (p.first_row + row) / p.plane_rows;
    vec4 sum[kSums * kBlocks];
    for (uint s = 0u; s < kSums * kBlocks; ++s)
        sum[s] = vec4(0.0);
    const uint strip = (p.quads + kProductLanes - 1u) / kProductLanes * kTeam;
    const uint begin = lane / kTeam * strip, end = min(begin + strip, p.quads);
    for (uint quad = begin + lane % kTeam; quad < end; quad += kTeam)
        for (uint plane = 0u; plane < PLANES; ++plane) {
            vec4 x[kVectors];
            for (uint v = 0u; v < kVectors; ++v)
                x[v] = vectors[vector_of(v, first_plane + plane) * p.in_quads + quad];
            for (uint b = 0u; b < kBlocks; ++b) {
                const mat4 rows = block(row / 4u + b, quad, first_plane + plane);
                for (uint v = 0u; v < kVectors; ++v)
                    sum[(plane * kVectors + v) * kBlocks + b] += x[v] * rows;
            }
        }
    for (uint s = 0u; s < kSums * kBlocks; ++s)
        sums[s][lane] = sum[s];
    for (uint width = kProductLanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            for (uint s = 0u; s < kSums * kBlocks; ++s)
                sums[s][lane] += sums[s][lane + width];
    }
    barrier();
    for (uint s = lane; s < kSums * kProductRows; s += kProductLanes) {
        const uint plane = first_plane + s / kProductRows / kVectors;
        const uint place = (p.first_row + row) % p.plane_rows + s % kProductRows;
        if (place < p.count)
            result[vector_of(s / kProductRows % kVectors, plane) * p.out_width + place] =
                sums[s / 4u][0][s % 4u];
    }
}

#endif
