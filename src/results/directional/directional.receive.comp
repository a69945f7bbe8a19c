#version 460
#include "results/directional/directional.shared.h"
#include "solve/shooting/shooters.shared.h"
#include "atlas/packing/lumel.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/lumel.glsl"
#include "raster/world/receiving_point.glsl"
#include "raster/eyes/sees.glsl"
#include "solve/shooting/shot.glsl"
#include "results/directional/directional.glsl"

// Every lumel i sums the directions of the light of K shots. A shot gives it the irradiance dH =
// X_j A_j / (π p_j) · V · cosθ_i cosθ_j / (r² + A_j/π), so dH / cosθ_i is the radiance times the
// solid angle from its direction.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { DirectionalReceiveParams p; };

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
    load_sums(i, p.count, p.order);
    for (uint k = 0u; k < p.shots; ++k) {
        vec3 d;
        if (!arrives(r, k, p.views, p.near_radius, d))
            continue;
        const float r2 = dot(d, d);
        const float per_r = inversesqrt(r2);
        const float solid = dot(d, eyes[k].normal) * per_r / (r2 + shots[k].disc);
        float c[9];
        coefficients_of(-d * per_r, lumel.normal, p.order, c);
        add_light(c, shots[k].power * solid, p.order);
    }
    store_sums(i, p.count, p.order);
}
