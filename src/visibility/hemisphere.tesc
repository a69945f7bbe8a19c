#version 460
#include "visibility/eye_views.shared.h"
#include "visibility/hemisphere.glsl"

// Into how many pieces a triangle is cut. An edge's level depends on the edge alone, so that
// neighbours meet.

layout(vertices = 1) out;
layout(push_constant, scalar) uniform Params { LookParams p; };
layout(binding = 0, scalar) readonly buffer Eyes { Eye eyes[]; };
layout(location = 0) in vec3 world[];
layout(location = 1) in vec3 local[];
layout(location = 0) patch out vec3 corners[3];
layout(location = 3) patch out vec3 plane;  // plane · x = 1 for the points x of the triangle
layout(location = 4) patch out vec3 pole;
layout(location = 5) patch out uint apex;  // opposite the shortest edge
layout(location = 6) patch out uint triangle;

// A triangle nearer to the eye's own plane, or with its own plane nearer to the eye, than this
// part of the near distance is the surface the eye lies on, or seen edge-on.
const float kEdgeOn = 1.0 / 16.0;

// Every device can cut an edge into this number of pieces. More would be needed only by discs of a
// radius above 996 pixels: at 2048 a half circle is 0.62 pixels off.
const float kMostPieces = 64.0;

// A power of two: then the tessellator's rings fit one another, and inside no piece is much longer
// than at the edges.
float pieces(float angle)
{
    return clamp(exp2(ceil(log2(angle / p.chord))), 1.0, kMostPieces);
}

// The pole of the edges' planes if they agree on one, as about an eye close to the triangle's
// plane; else (0, 0, 0).
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
    // Of the world's positions, whose differences are exact: local ones would tilt a sliver.
    const Eye eye = eyes[p.eye];
    const vec3 normal = cross(world[1] - world[0], world[2] - world[0]);
    const float height = dot(world[0] - eye.position, normal);
    const float least = kEdgeOn * p.near;
    const bool shown = max(a.z, max(b.z, c.z)) > least && abs(height) > least * length(normal);
    const vec3 angles = vec3(angle_between(b, c), angle_between(c, a), angle_between(a, b));
    for (int i = 0; i < 3; ++i)
        gl_TessLevelOuter[i] = shown ? pieces(angles[i]) : 0.0;
    gl_TessLevelInner[0] =
        max(gl_TessLevelOuter[0], max(gl_TessLevelOuter[1], gl_TessLevelOuter[2]));
    pole = common_pole(a, b, c);
    apex = angles.x < angles.y ? (angles.x < angles.z ? 0u : 2u)
                               : (angles.y < angles.z ? 1u : 2u);
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
    plane = normal * mat3(eye.tangent, eye.bitangent, eye.normal) / height;
    triangle = uint(gl_PrimitiveID);
}
