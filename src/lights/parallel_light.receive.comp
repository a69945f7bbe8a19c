#version 460
#include "lights/parallel_light.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"

// Every lumel takes the light of K directions:
//
//     H = Σ_k  illuminance_k · V_k · max(cosθ_k, 0).
//
// Among coloured glass V differs from channel to channel, and each view tells of one.
// What is known of V is summed up as light_sums.shared.h says.

layout(local_size_x = kParallelGroup) in;
layout(push_constant, scalar) uniform Params { ParallelReceiveParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 3, scalar) readonly buffer Sources { ParallelSource sources[]; };
layout(binding = 4) uniform sampler2D parallel_image;
layout(binding = 5, scalar) buffer Sums { LightSums sums[]; };

#include "world/lumel.glsl"
#include "world/receiving_point.glsl"
#include "visibility/channel.glsl"
#include "visibility/parallel.glsl"
#include "visibility/first_met.glsl"
#include "visibility/piece_along.glsl"

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    LightSums sum = sums[i];
    for (uint n = 0u; n < p.views * p.points; ++n) {
        const uint k = n / p.points;
        const ParallelView view = views[p.first_view + k];
        const uint index = (p.first_view + k) / p.views_per_source;
        const ParallelSource source = sources[index];
        // The point moves over the lumel all the time.
        const LumelPoint point = receiving_point(lumel, i, index * p.points + n % p.points, p.seed,
                                                 p.centre != 0u);
        const float cosine = dot(point.normal, source.toward);
        if (cosine <= 0.0 || dot(point.facing, source.toward) <= 0.0)
            continue;
        const vec3 open = cosine / float(p.points) * source.illuminance * carried(view.channel);
        sum.open += open;
        const PieceInView piece = piece_along(view, pieces[point.piece]);
        RayMet ray;
        if (!find_ray(piece, place_in(view, point.position), vec2(p.layout_.side), ray))
            continue;
        const vec3 known = open / ray.chance;
        sum.known += known;
        const ivec2 place = ivec2(tile_corner(p.layout_, k)) + ivec2(ray.pixel);
        if (is_first(piece, ray, texelFetch(parallel_image, place, 0).x))
            sum.arrived += known;
    }
    sums[i] = sum;
}
