#version 460
#include "visibility/illumination_maps.shared.h"
#include "core/hash.glsl"
#include "visibility/alpha.glsl"
#include "visibility/illumination.glsl"
#include "visibility/parallel.glsl"
#include "visibility/illumination.list.glsl"

// illumination.list.frag for surfaces with alpha.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
uniform sampler2D base_color;
layout(location = 1) in vec3 look;
layout(location = 0) in vec2 place;

void main()
{
    const ParallelView view = views[p.view];
    const Meeting met = meet(p.passage, base_color, look, view.channel, gl_FragCoord.xy,
                             gl_FragCoord.z, view.random);
    if (!met.blocked)
        discard;
    const uint surface = met.there ? surface_at(p, place) : kAbsorbing;
    append(p, surface);
}
