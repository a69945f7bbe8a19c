#version 460
#include "raster/parallel/parallel_views.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"

// Pixel of a surface with alpha in a parallel view.

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
