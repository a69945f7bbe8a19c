#version 460
#include "raster/parallel/parallel_views.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"

// A pixel of a surface with alpha, as it is seen along a direction.

layout(push_constant, scalar) uniform Params { ParallelLookParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
uniform sampler2D base_color;
layout(location = 0) in vec3 look;

void main()
{
    const ParallelView view = views[p.view];
    const Meeting met = meet(p.passage, base_color, look, view.channel, gl_FragCoord.xy,
                             gl_FragCoord.z, view.random);
    if (!met.blocked)
        discard;
}
