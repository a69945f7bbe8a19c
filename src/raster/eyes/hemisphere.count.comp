#version 460
#include "raster/eyes/hemisphere.shared.h"
#include "raster/eyes/hemisphere.cut.glsl"

// Counts the pieces and patches of each block of triangles: running counts per triangle, and
// totals.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CutParams p; };
layout(scalar) readonly buffer Cuts { uint cuts[]; };
layout(scalar) writeonly buffer Counts { CutCount counts[]; };           // [eye][slot]
layout(scalar) writeonly buffer BlockCounts { CutCount block_counts[]; };  // [eye][block]

void main()
{
    const uint eye = gl_GlobalInvocationID.x / p.blocks;
    if (eye >= p.eyes)
        return;
    const uint block = eye * p.eye_blocks + p.first_block + gl_GlobalInvocationID.x % p.blocks;
    CutCount count = CutCount(0u, 0u);
    for (uint i = 0u; i < kCutBlock; ++i) {
        const Cut cut = unpacked_cut(cuts[block * kCutBlock + i]);
        count.pieces += cut.kind == kStrip ? pieces_of(strip_of(cut)) : 0u;
        count.patches += cut.kind == kPatch ? 1u : 0u;
        counts[block * kCutBlock + i] = count;
    }
    block_counts[block] = count;
}
