#version 460
#include "links/sweeps/sweeps.shared.h"

// Adds light along the links of a slab, one row of a slice per invocation.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { SweepGatherParams p; };
layout(scalar) readonly buffer Slices { LinkSlice slices[]; };
layout(scalar) readonly buffer Words { uint words[]; };
layout(scalar) readonly buffer Sent { vec4 sent[]; };
layout(scalar) buffer Gathered { vec4 gathered[]; };

void main()
{
    const uint at = p.range.first + gl_GlobalInvocationID.x;
    const uint row = at % kSliceRows;
    if (at / kSliceRows >= p.slices)
        return;
    const LinkSlice slice = slices[at / kSliceRows];
    if (row >= slice.rows)
        return;
    const uint part = words[slice.first + row], size = slice.columns * kSliceRows;
    const uint first = slice.first + kSliceRows + row, last = slice.first + kSliceRows + size;
    const uint weights = size, colors = (slice.kinds & kWeights) != 0u ? 2u * size : size;
    precise vec4 sum = gathered[part];
    if (slice.kinds == 0u) {
        for (uint link = first; link < last; link += kSliceRows)
            sum += sent[words[link]];
    } else {
        for (uint link = first; link < last; link += kSliceRows) {
            precise vec4 light = sent[words[link]];
            if ((slice.kinds & kWeights) != 0u)
                light *= uintBitsToFloat(words[link + weights]);
            if ((slice.kinds & kColors) != 0u)
                light *= vec4(near_weight(words[link + colors]), 0.0);
            sum += light;
        }
    }
    gathered[part] = sum;
}
