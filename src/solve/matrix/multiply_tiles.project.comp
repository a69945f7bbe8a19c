#version 460
#include "solve/matrix/multiply_tiles.shared.h"

// From patches to coefficients, x̂ = Q x: a group for each cluster, an invocation for each
// coefficient. Planes are [states][3][clusters · kCluster].

layout(local_size_x = kCluster) in;
layout(push_constant, scalar) uniform Params { TileParams p; };
layout(scalar) readonly buffer First { uint first_basis[]; };
layout(scalar) readonly buffer Basis { uint basis[]; };  // [kept][kCluster / 4]
layout(scalar) readonly buffer Unit { float unit[]; };  // of each row
layout(scalar) readonly buffer In { float patches[]; };
layout(scalar) writeonly buffer Out { float coefficients[]; };

shared vec3 light[kCluster];

void main()
{
    const uint me = gl_LocalInvocationID.x;
    const uint cluster = gl_WorkGroupID.x % p.clusters, state = gl_WorkGroupID.x / p.clusters;
    const uint width = p.clusters * kCluster, place = cluster * kCluster + me;
    for (uint c = 0u; c < 3u; ++c)
        light[me][c] = patches[(state * 3u + c) * width + place];
    barrier();
    vec3 sum = vec3(0.0);
    const uint row = first_basis[cluster] + me;
    if (row < first_basis[cluster + 1u]) {
        for (uint quad = 0u; quad < kCluster / 4u; ++quad) {
            const vec4 weights = unpackSnorm4x8(basis[row * (kCluster / 4u) + quad]);
            for (uint i = 0u; i < 4u; ++i)
                sum += weights[i] * light[4u * quad + i];
        }
        sum *= unit[row];
    }
    for (uint c = 0u; c < 3u; ++c)
        coefficients[(state * 3u + c) * width + place] = sum[c];
}
