#version 460
#include "matrix/multiply_tiles.shared.h"

// From patches to coefficients, x̂ = Q x: a group for each cluster, an invocation for each
// coefficient. Planes are [states][3][clusters · kCluster].

layout(local_size_x = kCluster) in;
layout(push_constant, scalar) uniform Params { TileParams p; };
layout(binding = 0, scalar) readonly buffer First { uint first_basis[]; };
layout(binding = 1, scalar) readonly buffer Basis { uint basis[]; };  // [kept][kCluster / 2]
layout(binding = 2, scalar) readonly buffer In { float patches[]; };
layout(binding = 3, scalar) writeonly buffer Out { float coefficients[]; };

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
    if (row < first_basis[cluster + 1u])
        for (uint pair = 0u; pair < kCluster / 2u; ++pair) {
            const vec2 weight = unpackHalf2x16(basis[row * (kCluster / 2u) + pair]);
            sum += weight.x * light[2u * pair] + weight.y * light[2u * pair + 1u];
        }
    for (uint c = 0u; c < 3u; ++c)
        coefficients[(state * 3u + c) * width + place] = sum[c];
}
