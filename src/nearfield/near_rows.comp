#version 460
#include "nearfield/near_rows.shared.h"

// The near field's light:  H_i = Σ_j F_ij X_j  over the sparse row of lumel i.

layout(local_size_x = kNearGroup) in;
layout(push_constant, scalar) uniform Params { NearParams p; };
layout(binding = 0, scalar) readonly buffer First { uint first[]; };
layout(binding = 1, scalar) readonly buffer Column { uint column[]; };
layout(binding = 2, scalar) readonly buffer Factor { float factor[]; };
layout(binding = 3, scalar) readonly buffer Source { vec3 source[]; };
layout(binding = 4, scalar) writeonly buffer Near { vec3 near[]; };

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
