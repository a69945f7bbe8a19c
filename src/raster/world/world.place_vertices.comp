#version 460
#include "raster/world/world.shared.h"

// Transforms the occluders' vertices to the world.

layout(local_size_x = kGroup) in;
layout(push_constant, scalar) uniform Params { CountParams p; };
layout(scalar) readonly buffer Placements { Placement placements[]; };
layout(scalar) readonly buffer LocalVertices { vec3 local_vertices[]; };
layout(scalar) readonly buffer Instances { uint instances[]; };
layout(scalar) writeonly buffer Vertices { vec3 vertices[]; };

void main()
{
    const uint i = gl_GlobalInvocationID.x;
    if (i >= p.count)
        return;
    vertices[i] = (placements[instances[i]].now * vec4(local_vertices[i], 1.0)).xyz;
}
