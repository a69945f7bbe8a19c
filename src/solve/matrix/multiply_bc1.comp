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

shared vec3 sums[kBc1Rows][kBc1Lanes];

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

// Adds up what the lanes hold of each row of one state, and writes the totals.
void write_sums(uint lane, uint first_row, uint state)
{
    for (uint width = kBc1Lanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            for (uint row = 0u; row < kBc1Rows; ++row)
                sums[row][lane] += sums[row][lane + width];
    }
    barrier();
    if (lane < kBc1Rows && first_row + lane < p.width)
        for (uint c = 0u; c < 3u; ++c)
            sent[plane_of(state, c) + first_row + lane] = sums[lane][0][c];
}

void main()
{
    const uint lane = gl_LocalInvocationID.x;
    const uint first_row = gl_WorkGroupID.x * kBc1Rows;
    vec3 sum[kStates][kBc1Rows];
    for (uint s = 0u; s < kStates; ++s)
        for (uint row = 0u; row < kBc1Rows; ++row)
            sum[s][row] = vec3(0.0);
    for (uint column = lane; column < p.width; column += kBc1Lanes) {
        vec3 x[kStates];
        for (uint s = 0u; s < kStates; ++s)
            for (uint c = 0u; c < 3u; ++c)
                x[s][c] = received[plane_of(s, c) + column];
        for (uint row = 0u; row < kBc1Rows; ++row) {
            const vec3 factor = entry(first_row + row, column);
            for (uint s = 0u; s < kStates; ++s)
                sum[s][row] += factor * x[s];
        }
    }
    for (uint s = 0u; s < kStates; ++s) {
        barrier();
        for (uint row = 0u; row < kBc1Rows; ++row)
            sums[row][lane] = sum[s][row];
        write_sums(lane, first_row, s);
    }
}
