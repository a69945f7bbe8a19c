#version 460
#include "raster/parallel/parallel_views.shared.h"
#include "raster/parallel/parallel.glsl"

// parallel.vert for surfaces with alpha: passes texture coordinates too.

layout(push_constant, scalar) uniform Params { ParallelLookParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 look;  // u, v, alpha factor
layout(location = 0) out vec3 look_out;

void main()
{
    gl_Position = through_parallel(views[p.view], p.tiling, position);
    look_out = look;
}
