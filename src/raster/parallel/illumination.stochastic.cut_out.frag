#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"
#include "raster/parallel/illumination.depth.glsl"
#include "raster/parallel/illumination.glsl"
#include "raster/parallel/illumination.stochastic.glsl"

// illumination.stochastic.frag for surfaces with alpha.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
uniform sampler2D base_color;
layout(location = 1) in vec3 look;
layout(location = 0) in vec2 place;
layout(location = 0) out uvec4 fragment;

void main()
{
    const ParallelView view = views[p.view];
    const float nearness = nearness_at(p, gl_FragCoord.z);
    fragment = sample_of(nearness);
    const Meeting met = meet(p.passage, base_color, look, view.channel, gl_FragCoord.xy, nearness,
                             view.random);
    if (!met.blocked)
        discard;
    fragment.x = met.there ? surface_at(p, place) : kAbsorbing;
    gl_FragDepth = deciding_depth(p, fragment.xy, view.random);
}
