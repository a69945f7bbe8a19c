#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.cut.glsl"

// A corner of a piece of a strip.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Vertices { vec3 vertices[]; };
layout(scalar) readonly buffer Indices { uint indices[]; };
#include "raster/eyes/hemisphere.find.glsl"
layout(scalar) readonly buffer Cuts { uint cuts[]; };

layout(location = 0) flat out vec3 plane;  // plane · x = 1 for points x of the triangle
layout(location = 1) flat out uint triangle;

void main()
{
    const Found found = find_triangle(gl_VertexIndex / 3u, false);
    triangle = found.triangle;
    const Strip strip = strip_of(unpacked_cut(cuts[p.first_block * kCutBlock + triangle]));
    const OutlinePoint at = strip_corner(strip, found.number, gl_VertexIndex % 3u);
    const uint first = p.first_index + 3u * triangle;
    const vec3 world[3] = vec3[](vertices[indices[first]], vertices[indices[first + 1u]],
                                 vertices[indices[first + 2u]]);
    const Eye eye = eyes[p.eye];
    const mat3 frame = mat3(eye.tangent, eye.bitangent, eye.normal);
    const vec3 from = (world[at.from] - eye.position) * frame;
    const vec3 to = (world[at.to] - eye.position) * frame;
    const float part = float(at.step) / float(at.steps);
    gl_Position = projected(on_arc(normalize(from), normalize(to), 1.0 - part, part));
    const vec3 normal = cross(world[1] - world[0], world[2] - world[0]);
    plane = normal * frame / dot(world[0] - eye.position, normal);
}
