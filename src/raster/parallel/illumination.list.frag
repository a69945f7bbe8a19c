#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/illumination.glsl"
#include "raster/parallel/parallel.glsl"
#include "raster/parallel/illumination.list.glsl"

// A pixel of an illumination map that keeps all surfaces: put in front of the pixel's list.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec2 place;

void main()
{
    append(p, surface_at(p, place));
}
