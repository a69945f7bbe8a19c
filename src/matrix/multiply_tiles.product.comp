#version 460
#include "matrix/multiply_tiles.shared.h"

// ŷ = T x̂, T a sparse matrix of tiles for each axis of colours. Eight invocations share a row of
// tiles and take turns, so that those of a group read neighbouring tiles.

layout(local_size_x = kTileGroup) in;
layout(push_constant, scalar) uniform Params { TileParams p; };
layout(binding = 0, scalar) readonly buffer First { uint first[]; };  // [kind][axis][rows + 1]
layout(binding = 1, scalar) readonly buffer FinePlace { uint fine_place[]; };
layout(binding = 2, scalar) readonly buffer Fine { uvec4 fine[]; };  // a row of 4 × 8 bits each
layout(binding = 3, scalar) readonly buffer CoarsePlace { uint coarse_place[]; };
layout(binding = 4, scalar) readonly buffer Coarse { uvec2 coarse[]; };  // two rows of 4 × 4 bits
layout(binding = 5, scalar) readonly buffer In { vec4 seen[]; };         // [states][3][rows]
layout(binding = 6, scalar) writeonly buffer Out { vec4 sent[]; };       // the same

// Four rows' light, for each channel.
struct Light { vec4 channel[3]; };

shared Light parts[kTileGroup];

// Rows of the tile are columns of `rows`, so that rows · x is their dot products with x.
void add_tile(inout Light sum, mat4 rows, uint place, uint state, uint row_count, vec3 axis)
{
    const float scale = unpackHalf2x16(place).y * p.unit;
    const uint column = place & 0xffffu;
    for (uint c = 0u; c < 3u; ++c)
        sum.channel[c] += axis[c] * scale * (seen[(state * 3u + c) * row_count + column] * rows);
}

vec4 signed_nibbles(uint bits)
{
    const ivec4 left = ivec4(uvec4(bits << 28, bits << 24, bits << 20, bits << 16));
    return vec4(left >> 28) / kCoarseCodes;
}

mat4 fine_rows(uvec4 codes)
{
    return mat4(unpackSnorm4x8(codes.x), unpackSnorm4x8(codes.y), unpackSnorm4x8(codes.z),
                unpackSnorm4x8(codes.w));
}

mat4 coarse_rows(uvec2 codes)
{
    return mat4(signed_nibbles(codes.x), signed_nibbles(codes.x >> 16), signed_nibbles(codes.y),
                signed_nibbles(codes.y >> 16));
}

void main()
{
    const uint me = gl_LocalInvocationID.x, lane = me % kTileLanes;
    const uint row_count = p.clusters * (kCluster / kTile);
    const uint element = gl_GlobalInvocationID.x / kTileLanes;
    const uint state = element / row_count, row = element % row_count;
    Light sum;
    for (uint c = 0u; c < 3u; ++c)
        sum.channel[c] = vec4(0.0);
    if (state < p.states)
        for (uint a = 0u; a < 3u; ++a) {
            const vec3 axis = a == 0u ? kGrayAxis : (a == 1u ? kRedBlueAxis : kGreenAxis);
            const uint fine_row = a * (row_count + 1u) + row;
            const uint coarse_row = (a + 3u) * (row_count + 1u) + row;
            for (uint t = first[fine_row] + lane; t < first[fine_row + 1u]; t += kTileLanes)
                add_tile(sum, fine_rows(fine[t]), fine_place[t], state, row_count, axis);
            for (uint t = first[coarse_row] + lane; t < first[coarse_row + 1u]; t += kTileLanes)
                add_tile(sum, coarse_rows(coarse[t]), coarse_place[t], state, row_count, axis);
        }
    parts[me] = sum;
    for (uint width = kTileLanes / 2u; width > 0u; width /= 2u) {
        barrier();
        if (lane < width)
            for (uint c = 0u; c < 3u; ++c)
                parts[me].channel[c] += parts[me + width].channel[c];
    }
    if (state < p.states && lane == 0u)
        for (uint c = 0u; c < 3u; ++c)
            sent[(state * 3u + c) * row_count + row] = parts[me].channel[c];
}
