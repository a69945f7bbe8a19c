// result ← matrix vectors. A group has 8 rows, its lanes take turns in quads of 4 columns; what a
// lane reads of the vectors serves all rows. Sums end in an order that never changes.
//
// Before this: kPlanes, how many planes a block holds, and
//     vec4 part(uint block_row, uint quad, uint plane, uint r)
// entries of row 4 block_row + r, columns 4 quad … + 3 (of this part of the matrix).

layout(constant_id = 0) const uint kVectors = 1u;
const uint kSums = kPlanes * kVectors;  // of a row

layout(local_size_x = kProductLanes) in;
layout(binding = 1, scalar) readonly buffer Vectors { vec4 vectors[]; };
layout(binding = 2, scalar) writeonly buffer Result { float result[]; };

shared float sums[kSums * kProductRows][kProductLanes];

uint vector_of(uint v, uint plane)
{
    return p.first_vector + v * p.vector_step + plane * p.plane_step;
}

void main()
{
    const uint lane = gl_LocalInvocationID.x;
    const uint row = gl_WorkGroupID.x * kProductRows;
    const uint first_plane = (p.first_row + row) / p.plane_rows;
    float sum[kSums][kProductRows];
    for (uint s = 0u; s < kSums; ++s)
        for (uint r = 0u; r < kProductRows; ++r)
            sum[s][r] = 0.0;
    for (uint quad = lane; quad < p.quads; quad += kProductLanes)
        for (uint plane = 0u; plane < kPlanes; ++plane) {
            vec4 x[kVectors];
            for (uint v = 0u; v < kVectors; ++v)
                x[v] = vectors[vector_of(v, first_plane + plane) * p.in_quads + quad];
            for (uint r = 0u; r < kProductRows; ++r) {
                const vec4 entries = part(row / 4u + r / 4u, quad, first_plane + plane, r % 4u);
                for (uint v = 0u; v < kVectors; ++v)
                    sum[plane * kVectors + v][r] += dot(entries, x[v]);
            }
        }
    for (uint s = 0u; s < kSums; ++s)
        for (uint r = 0u; r < kProductRows; ++r)
            sums[s * kProductRows + r][lane] = sum[s][r];
    for (uint width = kProductLanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            for (uint s = 0u; s < kSums * kProductRows; ++s)
                sums[s][lane] += sums[s][lane + width];
    }
    barrier();
    for (uint s = lane; s < kSums * kProductRows; s += kProductLanes) {
        const uint plane = first_plane + s / kProductRows / kVectors;
        const uint place = (p.first_row + row) % p.plane_rows + s % kProductRows;
        if (place < p.count)
            result[vector_of(s / kProductRows % kVectors, plane) * p.out_width + place] =
                sums[s][0];
    }
}
