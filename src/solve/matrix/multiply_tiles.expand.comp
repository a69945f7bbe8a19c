#version 460
#include "solve/matrix/multiply_tiles.shared.h"

// From coefficients back to patches, y = Q^T ŷ: a group for each cluster, an invocation for each
// patch. Planes are [states][3][clusters · kCluster].

layout(local_size_x = kCluster) in;
layout(push_constant, scalar) uniform Params { TileParams p; };
layout(scalar) readonly buffer First { uint first_basis[]; };
layout(scalar) readonly buffer Basis { uint basis[]; };  // [kept][kCluster / 4]
layout(scalar) readonly buffer Unit { float unit[]; };  // of each row
layout(scalar) readonly buffer In { float coefficients[]; };
layout(scalar) writeonly buffer Out { float patches[]; };

shared vec3 light[kCluster];

void main()
{
    const uint me = gl_LocalInvocationID.x;
    const uint cluster = gl_WorkGroupID.x % p.clusters, state = gl_WorkGroupID.x / p.clusters;
    const uint width = p.clusters * kCluster, place = cluster * kCluster + me;
    for (uint c = 0u; c < 3u; ++c)
        light[me][c] = coefficients[(state * 3u + c) * width + place];
    barrier();
    vec3 sum = vec3(0.0);
    const uint first = first_basis[cluster], kept = first_basis[cluster + 1u] - first;
    for (uint k = 0u; k < kept; ++k) {
        const vec4 weights = unpackSnorm4x8(basis[(first + k) * (kCluster / 4u) + me / 4u]);
        sum += weights[me % 4u] * unit[first + k] * light[k];
    }
    for (uint c = 0u; c < 3u; ++c)
        patches[(state * 3u + c) * width + place] = sum[c];
}
