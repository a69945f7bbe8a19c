#version 460
#include "raster/parallel/parallel_views.shared.h"
#include "raster/parallel/parallel.glsl"

// A vertex projected along a direction.

layout(push_constant, scalar) uniform Params { ParallelLookParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec3 position;

void main()
{
    gl_Position = through_parallel(views[p.view], p.tiling, position);
}
