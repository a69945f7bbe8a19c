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
    const ParallelView view = views[p.view];
    const vec4 base = textureLod(base_color, look.xy, 0.0) * vec4(vec3(1.0), look.z);
    const Opacity opacity = opacity_of(p.passage, base, view.channel);
    const float chance = chance_at(gl_FragCoord.xy, gl_FragCoord.z, view.random);
    if (chance >= opacity.blocked)
        discard;
}
