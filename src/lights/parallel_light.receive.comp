#version 460
#include "lights/parallel_light.shared.h"
#include "atlas/lumel.shared.h"
#include "core/hash.glsl"

// Every lumel takes the light of K directions that reaches it:
//
//     H += Σ_k  illuminance_k · V · max(cosθ, 0).
//
// The point that receives moves over the lumel from direction to direction.

layout(local_size_x = kParallelGroup) in;
layout(push_constant, scalar) uniform Params { ParallelReceiveParams p; };
layout(binding = 0, scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(binding = 1, scalar) readonly buffer Pieces { Piece pieces[]; };
layout(binding = 2, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 3, scalar) readonly buffer Sources { ParallelSource sources[]; };
layout(binding = 4) uniform sampler2D parallel_image;
layout(binding = 5, scalar) buffer Irradiance { vec3 irradiance[]; };

#include "world/lumel.glsl"
#include "world/receiving_point.glsl"
#include "visibility/parallel.glsl"
#include "visibility/sees_along.glsl"

void main()
{
    const uint i = p.first + gl_GlobalInvocationID.x;
    if (i >= p.last)
        return;
    const Lumel lumel = lumels[i];
    if ((lumel.flags & kLumelBuried) != 0u)
        return;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < p.views; ++k) {
        const ParallelSource source = sources[p.first_view + k];
        const LumelPoint point =
            receiving_point(lumel, i, p.first_view + k, p.seed, p.centre != 0u);
        const float cosine = dot(point.normal, source.toward);
        if (cosine <= 0.0 || dot(point.facing, source.toward) <= 0.0)
            continue;
        if (light_arrives(p.layout_, k, views[p.first_view + k], pieces[point.piece],
                          point.position))
            sum += cosine * source.illuminance;
    }
    irradiance[i] += sum;
}
