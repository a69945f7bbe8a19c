#version 460
#include "base/core/dispatch.shared.h"

// The near field's light:  H_i = Σ_j F_ij X_j  over the sparse row of lumel i.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer First { uint first[]; };
layout(scalar) readonly buffer Column { uint column[]; };
layout(scalar) readonly buffer Factor { float factor[]; };
layout(scalar) readonly buffer Source { vec3 source[]; };
layout(scalar) writeonly buffer Near { vec3 near[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    vec3 sum = vec3(0.0);
    for (uint k = first[i]; k < first[i + 1u]; ++k)
        sum += factor[k] * source[column[k]];
    near[i] = sum;
}
