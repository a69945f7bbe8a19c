#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"
#include "raster/parallel/illumination.glsl"

// illumination.peel.frag for surfaces with alpha.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
uniform sampler2D base_color;
uniform usampler2D before;
layout(location = 1) in vec3 look;
layout(location = 0) in vec2 place;
layout(location = 0) out uvec2 fragment;

void main()
{
    const ParallelView view = views[p.view];
    const Meeting met = meet(p.passage, base_color, look, view.channel, gl_FragCoord.xy,
                             gl_FragCoord.z, view.random);
    if (!met.blocked ||
        !lies_behind(p, texelFetch(before, ivec2(gl_FragCoord.xy), 0).xy))
        discard;
    const uint surface = met.there ? surface_at(p, place) : kAbsorbing;
    fragment = uvec2(surface, floatBitsToUint(gl_FragCoord.z));
}
