#version 460
#include "raster/eyes/hemisphere.shared.h"

// Computes prefix sums of the block counts, and the arguments of the indirect draws.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CutParams p; };
layout(scalar) buffer BlockCounts { CutCount block_counts[]; };
layout(scalar) writeonly buffer Draws { DrawnVertices draws[]; };

void main()
{
    const uint eye = gl_GlobalInvocationID.x;
    if (eye >= p.eyes)
        return;
    const uint first = eye * p.eye_blocks + p.first_block;
    CutCount before = CutCount(0u, 0u);
    for (uint i = 0u; i < p.blocks; ++i) {
        const CutCount own = block_counts[first + i];
        block_counts[first + i] = before;
        before = CutCount(before.pieces + own.pieces, before.patches + own.patches);
    }
    const uint draw = eye * p.eye_draws + p.first_draw;
    draws[draw] = DrawnVertices(3u * before.pieces, 1u, 0u, 0u);
    draws[draw + 1u] = DrawnVertices(3u * before.patches, 1u, 0u, 0u);
}
