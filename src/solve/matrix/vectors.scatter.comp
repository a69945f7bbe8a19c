#version 460
#include "solve/matrix/vectors.shared.h"

// Brings planes, [states][3][width], back into the patches' order and adds the exact part's light.
// Eight invocations share a patch, so that those of a group read neighbouring entries.

layout(local_size_x = kVectorGroup) in;
layout(push_constant, scalar) uniform Params { ScatterParams p; };
layout(scalar) readonly buffer Place { uint place[]; };  // [n] of each patch
layout(scalar) readonly buffer Weight { float weight[]; };  // [n]
layout(scalar) readonly buffer Planes { float planes[]; };
layout(scalar) readonly buffer Columns { uint columns[]; };  // 16 bits each
layout(scalar) readonly buffer Values { float values[]; };  // [3][n][per_row]
layout(scalar) readonly buffer Source { vec3 source[]; };  // x, [states][n]
layout(scalar) writeonly buffer Result { vec3 result[]; };  // y

shared vec3 parts[kVectorGroup];

vec3 exact_light(uint state, uint row, uint lane)
{
    vec3 sum = vec3(0.0);
    for (uint c = 0u; c < 3u; ++c)
        for (uint k = lane; k < p.per_row; k += kScatterLanes) {
            const uint entry = (c * p.count + row) * p.per_row + k;
            const uint column = columns[entry / 2u] >> (16u * (entry % 2u)) & 0xffffu;
            sum[c] += values[entry] * source[state * p.count + column][c];
        }
    return sum;
}

void main()
{
    const uint me = gl_LocalInvocationID.x, lane = me % kScatterLanes;
    const uint element = gl_GlobalInvocationID.x / kScatterLanes;
    const uint state = element / p.count, row = element % p.count;
    const bool inside = state < p.states;
    parts[me] = inside && p.per_row > 0u ? exact_light(state, row, lane) : vec3(0.0);
    for (uint width = kScatterLanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            parts[me] += parts[me + width];
    }
    if (!inside || lane != 0u)
        return;
    vec3 light;
    for (uint c = 0u; c < 3u; ++c)
        light[c] = planes[(state * 3u + c) * p.width + place[row]];
    result[element] = light * weight[row] + parts[me];
}
