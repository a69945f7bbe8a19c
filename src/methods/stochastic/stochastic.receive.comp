#version 460
#include "methods/stochastic/stochastic.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/shooting/shot.glsl"

// Every lumel i receives from all K shots of a batch ([BJ04] Eq. (3)):
//
//     H_i += Σ_k  X_j A_j / (π p_j) · V · cosθ_i cosθ_j / (r² + d),       j = j(k),
//
// with d = 0, or the disc A_j/π of [BSS05] Eq. (8). Pairs of the near field are left out: it holds
// them exactly. The point x moves over the lumel from batch to batch.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { ReceiveParams p; };
layout(scalar) buffer Direct { vec3 direct[]; };  // [2][N] sums
layout(scalar) buffer Indirect { vec3 indirect[]; };  // [2][N] sums

vec3 receive(Receiver r, uint k)
{
    vec3 d;
    // Where the normal is interpolated, light can come from behind the triangle.
    if (!arrives(r, k, p.views, p.near_radius, d) || dot(d, r.facing) >= 0.0)
        return vec3(0.0);
    return shots[k].power * point_factor(d, eyes[k].normal, r.normal, shots[k].disc);
}

void main()
{
    const uint i = p.range.first + gl_GlobalInvocationID.x;
    if (i >= p.range.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    const LumelPoint point = receiving_point(lumel, i, p.iteration, p.seed, p.centre != 0u);
    const Receiver r = receiver_at(point, lumel, i);
    const uint at = p.half_index * p.count + i;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.emission_shots; ++k)
        sum += receive(r, k);
    if (p.emission_shots > 0u)
        direct[at] += sum;
    sum = vec3(0.0);
    for (uint k = p.emission_shots; k < p.shots; ++k)
        sum += receive(r, k);
    if (p.emission_shots < p.shots)
        indirect[at] += sum;
}
