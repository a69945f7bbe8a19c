#version 460
#include "../tests/gpu/twice.shared.h"

// value ← 2 value + added, to see that work happens, in order.

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Params { TwiceParams p; };
layout(scalar) buffer Values { uint values[]; };

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i < p.last)
        values[i] = 2u * values[i] + p.added;
}
