#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/illumination.glsl"
#include "raster/parallel/parallel.glsl"
#include "raster/parallel/illumination.list.glsl"

// Prepends a surface to the pixel's list in an illumination map of all surfaces.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec2 place;

void main()
{
    append(p, surface_at(p, place));
}
