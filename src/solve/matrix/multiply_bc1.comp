#version 460
#include "solve/matrix/log_code.shared.h"
#include "solve/matrix/multiply_bc1.shared.h"

// y = M x for kStates states of light: M a texture of logarithms in BC1 blocks, decoded by the
// texture unit [SF17 section 3.5]. A group has kBc1Rows rows, whose columns its lanes share. Planes
// are [states][3][width]. Sums end in an order that never changes.

layout(constant_id = 0) const uint kStates = 1u;

layout(local_size_x = kBc1Lanes) in;
layout(push_constant, scalar) uniform Params { Bc1Params p; };
uniform sampler2D codes;
layout(scalar) readonly buffer In { float received[]; };
layout(scalar) writeonly buffer Out { float sent[]; };

const uint kSums = kBc1Rows * kStates;

shared vec3 sums[kSums][kBc1Lanes];

uint plane_of(uint state, uint channel)
{
    return ((p.first_state + state) * 3u + channel) * p.width;
}

vec3 entry(uint row, uint column)
{
    const vec3 code = texelFetch(codes, ivec2(column, row), 0).rgb * kLogCodes;
    const vec3 value = exp2(code * p.log_step + p.log_factor);
    return mix(value, vec3(0.0), lessThan(code, vec3(kMinLogCode)));
}

void main()
{
    const uint lane = gl_LocalInvocationID.x;
    const uint first_row = gl_WorkGroupID.x * kBc1Rows;
    vec3 sum[kSums];
    for (uint s = 0u; s < kSums; ++s)
        sum[s] = vec3(0.0);
    for (uint column = lane; column < p.width; column += kBc1Lanes) {
        vec3 x[kStates];
        for (uint s = 0u; s < kStates; ++s)
            for (uint c = 0u; c < 3u; ++c)
                x[s][c] = received[plane_of(s, c) + column];
        for (uint row = 0u; row < kBc1Rows; ++row) {
            const vec3 factor = entry(first_row + row, column);
            for (uint s = 0u; s < kStates; ++s)
                sum[s * kBc1Rows + row] += factor * x[s];
        }
    }
    for (uint s = 0u; s < kSums; ++s)
        sums[s][lane] = sum[s];
    for (uint width = kBc1Lanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            for (uint s = 0u; s < kSums; ++s)
                sums[s][lane] += sums[s][lane + width];
    }
    barrier();
    for (uint s = lane; s < kSums; s += kBc1Lanes)
        if (first_row + s % kBc1Rows < p.width)
            for (uint c = 0u; c < 3u; ++c)
                sent[plane_of(s / kBc1Rows, c) + first_row + s % kBc1Rows] = sums[s][0][c];
}
