#version 460
#include "solve/matrix/multiply_tiles.shared.h"

// ŷ = T x̂, T a sparse matrix of tiles for each axis of colours. Eight invocations share a row of
// tiles and take turns, so that those of a group read neighbouring tiles.

layout(local_size_x = kTileGroup) in;
layout(push_constant, scalar) uniform Params { TileParams p; };
layout(scalar) readonly buffer First { uint first[]; };  // [bits][axis][rows + 1]
layout(scalar) readonly buffer Place { uint place[]; };  // of all tiles
layout(scalar) readonly buffer Codes4 { uvec2 codes4[]; };  // one each
layout(scalar) readonly buffer Codes8 { uvec4 codes8[]; };
layout(scalar) readonly buffer Codes16 { uvec4 codes16[][2]; };
layout(scalar) readonly buffer In { vec4 seen[]; };  // [states][3][rows]
layout(scalar) writeonly buffer Out { vec4 sent[]; };  // the same

// Four rows' light, for each channel.
struct Light { vec4 channel[3]; };

shared Light parts[kTileGroup];

vec4 signed_nibbles(uint bits)
{
    const ivec4 left = ivec4(uvec4(bits << 28, bits << 24, bits << 20, bits << 16));
    return vec4(left >> 28) / kCodes4;
}

vec4 shorts(uvec2 words)
{
    return vec4(unpackSnorm2x16(words.x), unpackSnorm2x16(words.y));
}

// Rows of a tile as columns, so that x · columns is their dot products with x.
mat4 rows_of(uint digits, uint tile)
{
    if (digits == 0u) {
        const uvec2 codes = codes4[tile];
        return mat4(signed_nibbles(codes.x), signed_nibbles(codes.x >> 16),
                    signed_nibbles(codes.y), signed_nibbles(codes.y >> 16));
    }
    if (digits == 1u) {
        const uvec4 codes = codes8[tile];
        return mat4(unpackSnorm4x8(codes.x), unpackSnorm4x8(codes.y), unpackSnorm4x8(codes.z),
                    unpackSnorm4x8(codes.w));
    }
    return mat4(shorts(codes16[tile][0].xy), shorts(codes16[tile][0].zw),
                shorts(codes16[tile][1].xy), shorts(codes16[tile][1].zw));
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
    for (uint kind = 0u; kind < 3u * kPrecisions && state < p.states; ++kind) {
        const uint digits = kind / 3u;
        const uint a = kind % 3u;
        const vec3 axis = a == 0u ? kGrayAxis : (a == 1u ? kRedBlueAxis : kGreenAxis);
        const uint begin = kind * (row_count + 1u) + row;
        for (uint t = first[begin] + lane; t < first[begin + 1u]; t += kTileLanes) {
            const mat4 rows = rows_of(digits, t - first[digits * 3u * (row_count + 1u)]);
            const float scale = unpackHalf2x16(place[t]).y * p.unit;
            const uint column = place[t] & 0xffffu;
            for (uint c = 0u; c < 3u; ++c)
                sum.channel[c] +=
                    axis[c] * scale * (seen[(state * 3u + c) * row_count + column] * rows);
        }
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
