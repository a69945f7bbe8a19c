#version 460
#include "visibility/parallel_views.shared.h"
#include "core/hash.glsl"
#include "visibility/alpha.glsl"

// A pixel of a surface with alpha, as it is seen along a direction.

layout(push_constant, scalar) uniform Params { ParallelLookParams p; };
layout(binding = 0, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 1) uniform sampler2D base_color;
layout(location = 0) in vec3 look;

void main()
{
    const float alpha = textureLod(base_color, look.xy, 0.0).a * look.z;
    if (!blocks(alpha, p.cutoff, gl_FragCoord.xy, gl_FragCoord.z, views[p.view].random))
        discard;
}
