#version 460
#include "raster/parallel/illumination_maps.shared.h"
#include "raster/parallel/parallel.glsl"
#include "raster/parallel/illumination.depth.glsl"

// A vertex projected along a direction, with its atlas position.

layout(push_constant, scalar) uniform Params { IlluminationParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 place;
layout(location = 0) out vec2 place_out;

void main()
{
    gl_Position = through_parallel(views[p.view], p.tiling, position);
    gl_Position.z = depth_of(p, gl_Position.z);
    place_out = place;
}
