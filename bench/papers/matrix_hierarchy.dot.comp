#version 460
#include "../bench/papers/matrix_hierarchy.shared.h"

// Rows of a matrix in blocks: an invocation adds up the segments of its row.

layout(local_size_x = kHierarchyGroup) in;
layout(push_constant, scalar) uniform Params { HierarchyParams p; };
layout(scalar) readonly buffer First { uint first[]; };  // [rows + 1] segment
layout(scalar) readonly buffer Segments { HierarchySegment segments[]; };
layout(scalar) readonly buffer Words { uint words[]; };
layout(scalar) readonly buffer Light { float light[]; };
layout(scalar) readonly buffer Seen { float seen[]; };
layout(scalar) writeonly buffer Result { float result[]; };

void main()
{
    const uint row = gl_GlobalInvocationID.x;
    if (row >= p.rows)
        return;
    float sum = 0.0;
    for (uint k = first[row]; k < first[row + 1u]; ++k) {
        const HierarchySegment segment = segments[k];
        for (uint i = 0u; i < segment.words; ++i) {
            const vec2 values = unpackHalf2x16(words[segment.word + i]);
            const uint at = segment.source + 2u * i;
            sum += segment.seen != 0u ? values.x * seen[at] + values.y * seen[at + 1u]
                                      : values.x * light[at] + values.y * light[at + 1u];
        }
    }
    result[row] = sum * p.scale[row / p.plane];
}
