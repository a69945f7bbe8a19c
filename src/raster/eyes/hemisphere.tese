#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.glsl"

// Projects a piece's vertex to the disc. The outputs for fragments are constant over the triangle.

layout(triangles, equal_spacing) in;
layout(location = 0) patch in vec3 corners[3];
layout(location = 3) patch in vec3 plane;
layout(location = 4) patch in vec3 pole;
layout(location = 5) patch in uint apex;
layout(location = 6) patch in uint triangle;
layout(location = 0) flat out vec3 plane_out;
layout(location = 1) flat out uint triangle_out;

// On an edge, where one coordinate is 0: uniform in angle.
vec3 on_edge(vec3 part)
{
    const vec3 a = normalize(corners[0]), b = normalize(corners[1]), c = normalize(corners[2]);
    if (part.x == 0.0)
        return on_arc(b, c, part.y, part.z);
    if (part.y == 0.0)
        return on_arc(c, a, part.z, part.x);
    return on_arc(a, b, part.x, part.y);
}

// Inside, for an eye close to the triangle's plane: on geodesics from the pole to the edges.
vec3 on_spoke(vec3 part)
{
    const float least = min(part.x, min(part.y, part.z));
    const float outward = 1.0 - 3.0 * least;
    const float kSmallest = 1e-6;
    if (outward < kSmallest)
        return pole;
    return on_arc(on_edge((part - least) / outward), pole, outward, 1.0 - outward);
}

// Inside, otherwise: on geodesics between the two longer edges.
vec3 on_rung(vec3 part)
{
    const uint i = apex, j = (apex + 1u) % 3u, k = (apex + 2u) % 3u;
    const vec3 a = normalize(corners[i]), b = normalize(corners[j]), c = normalize(corners[k]);
    const float rest = part[j] + part[k];
    return on_arc(on_arc(a, b, part[i], rest), on_arc(a, c, part[i], rest), part[j] / rest,
                  part[k] / rest);
}

// Pieces must not overlap, nor be longer inside than at the edges.
vec3 direction(vec3 part)
{
    if (min(part.x, min(part.y, part.z)) == 0.0)
        return on_edge(part);
    return pole != vec3(0.0) ? on_spoke(part) : on_rung(part);
}

void main()
{
    gl_Position = projected(direction(gl_TessCoord));
    plane_out = plane;
    triangle_out = triangle;
}
