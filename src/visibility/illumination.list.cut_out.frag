#version 460
#include "visibility/illumination_maps.shared.h"
#include "core/hash.glsl"
#include "visibility/alpha.glsl"
#include "visibility/illumination.glsl"

// illumination.list.frag for surfaces with alpha.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(binding = 0, scalar) readonly buffer Views { ParallelView views[]; };
layout(binding = 1) uniform sampler2D base_color;
layout(location = 1) in vec3 look;
layout(binding = 2, scalar) buffer Heads { uint heads[]; };  // [tiles][side][side]
layout(binding = 3, scalar) writeonly buffer Fragments { Fragment fragments[]; };
layout(binding = 4, scalar) buffer Count { FragmentCount total; };
layout(location = 0) in vec2 place;

#include "visibility/parallel.glsl"
#include "visibility/illumination.list.glsl"

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
