#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "base/core/hash.glsl"
#include "raster/parallel/illumination.depth.glsl"
#include "raster/parallel/illumination.glsl"
#include "raster/parallel/illumination.stochastic.glsl"

// Stochastic depths in an illumination map, [TN11] Figure 4: keeps the surface with the largest
// random number on the pixel's ray; with ordinary depths, the closest beyond a region.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec2 place;
layout(location = 0) out uvec4 fragment;

void main()
{
    fragment = sample_of(nearness_at(p, gl_FragCoord.z));
    fragment.x = surface_at(p, place);
    gl_FragDepth = deciding_depth(p, fragment.xy, views[p.view].random);
}
