#version 460
#include "visibility/parallel_views.shared.h"
#include "visibility/parallel.glsl"

// One vertex as it is seen along a direction.

layout(push_constant, scalar) uniform Params { ParallelLookParams p; };
layout(scalar) readonly buffer Views { ParallelView views[]; };
layout(location = 0) in vec3 position;

void main()
{
    gl_Position = through_parallel(views[p.view], p.tiling, position);
}
