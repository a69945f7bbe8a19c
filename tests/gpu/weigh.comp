#version 460
#include "../tests/gpu/weigh.shared.h"
#include "../tests/gpu/weigh.glsl"

// result ← weight · colour, at the place that the value has.

layout(local_size_x = kWeighGroup) in;
layout(push_constant, scalar) uniform Params { WeighParams p; };
layout(scalar) readonly buffer Values { Colored values[]; };
layout(scalar) writeonly buffer Result { vec3 result[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i < p.count)
        result[values[i].place] = weight_of(i) * values[i].color;
}
