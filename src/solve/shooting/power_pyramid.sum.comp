#version 460
#include "solve/shooting/power_pyramid.shared.h"

// One level of the pyramid: each parent sums its children.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { PyramidSumParams p; };
layout(scalar) buffer Pyramid { float pyramid[]; };

void main()
{
    const uint parent = gl_GlobalInvocationID.x;
    if (parent >= p.to_count)
        return;
    const uint first = parent * kPyramidFanout;
    const uint last = min(first + kPyramidFanout, p.from_count);
    float sum = 0.0;
    for (uint child = first; child < last; ++child)
        sum += pyramid[p.from + child];
    pyramid[p.to + parent] = sum;
}
