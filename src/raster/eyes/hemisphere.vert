#version 460
#include "raster/eyes/eye_views.shared.h"

// A triangle's corner for the tessellator, in world space and in the eye's frame.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Vertices { vec3 vertices[]; };
layout(scalar) readonly buffer Indices { uint indices[]; };
#include "raster/eyes/hemisphere.find.glsl"

layout(location = 0) out vec3 world;
layout(location = 1) out vec3 local;
layout(location = 2) out uint number;  // triangle index

void main()
{
    const Eye eye = eyes[p.eye];
    number = find_triangle(gl_VertexIndex / 3u, true).triangle;
    world = vertices[indices[p.first_index + 3u * number + gl_VertexIndex % 3u]];
    local = (world - eye.position) * mat3(eye.tangent, eye.bitangent, eye.normal);
}
