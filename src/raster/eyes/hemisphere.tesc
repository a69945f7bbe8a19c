#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.shared.h"
#include "raster/eyes/hemisphere.cut.glsl"

// Triangles that hemisphere.cut.comp leaves to the tessellator.

layout(vertices = 1) out;
layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
layout(scalar) readonly buffer Cuts { uint cuts[]; };
layout(location = 0) in vec3 world[];
layout(location = 1) in vec3 local[];
layout(location = 2) in uint number[];  // triangle index
layout(location = 0) patch out vec3 corners[3];
layout(location = 3) patch out vec3 plane;  // plane · x = 1 for points x of the triangle
layout(location = 4) patch out vec3 pole;
layout(location = 5) patch out uint apex;  // opposite the shortest edge
layout(location = 6) patch out uint triangle;

// Common pole of the edges' planes, which exists for eyes close to the triangle's plane; else (0,
// 0, 0).
vec3 common_pole(vec3 a, vec3 b, vec3 c)
{
    const vec3 ab = normalize(cross(a, b)), bc = normalize(cross(b, c)),
               ca = normalize(cross(c, a));
    const bool agree = min(dot(ab, bc), min(dot(bc, ca), dot(ca, ab))) > 0.0;
    return agree ? normalize(sign(dot(ab, c)) * (ab + bc + ca)) : vec3(0.0);
}

void main()
{
    const vec3 a = local[0], b = local[1], c = local[2];
    // From world positions, whose differences are exact; local ones would tilt a sliver.
    const Eye eye = eyes[p.eye];
    const vec3 normal = cross(world[1] - world[0], world[2] - world[0]);
    const float height = dot(world[0] - eye.position, normal);
    const Cut cut = unpacked_cut(cuts[p.first_block * kCutBlock + number[0]]);
    for (int i = 0; i < 3; ++i)
        gl_TessLevelOuter[i] = float(1u << cut.levels[i]);
    gl_TessLevelInner[0] =
        max(gl_TessLevelOuter[0], max(gl_TessLevelOuter[1], gl_TessLevelOuter[2]));
    pole = common_pole(a, b, c);
    apex = cut.apex;
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
    plane = normal * mat3(eye.tangent, eye.bitangent, eye.normal) / height;
    triangle = number[0];
}
