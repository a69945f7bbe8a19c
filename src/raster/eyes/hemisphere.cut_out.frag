#version 460
#include "raster/eyes/eye_views.shared.h"
#include "base/core/hash.glsl"
#include "raster/world/alpha.glsl"
#include "raster/eyes/hemisphere.glsl"

// hemisphere.frag for surfaces with alpha: interpolates at the ray's hit point.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(scalar) readonly buffer Eyes { Eye eyes[]; };
uniform sampler2D base_color;
layout(scalar) readonly buffer Vertices { vec3 vertices[]; };
layout(scalar) readonly buffer Looks { vec3 looks[]; };  // u, v, alpha factor
layout(scalar) readonly buffer Indices { uint indices[]; };
layout(location = 0) flat in vec3 plane;
layout(location = 1) flat in uint triangle;

// Barycentric coordinates of a point of the plane, clamped to the triangle.
vec3 barycentric(vec3 x, vec3 a, vec3 b, vec3 c)
{
    const vec3 normal = cross(b - a, c - a);
    const vec3 areas = vec3(dot(cross(b - x, c - x), normal), dot(cross(c - x, a - x), normal),
                            dot(cross(a - x, b - x), normal));
    const vec3 inside = max(areas, 0.0);
    return inside / (inside.x + inside.y + inside.z);
}

vec3 look_at(vec3 x)
{
    const uint first = p.first_index + 3u * triangle;
    const uint a = indices[first], b = indices[first + 1u], c = indices[first + 2u];
    const vec3 part = barycentric(x, vertices[a], vertices[b], vertices[c]);
    return mat3(looks[a], looks[b], looks[c]) * part;
}

void main()
{
    const Eye eye = eyes[p.eye];
    const vec3 ray = ray_through(gl_FragCoord.xy - vec2(p.corner), p.radius);
    const float nearness = dot(plane, ray);
    const float depth = p.near * nearness;
    if (depth > 1.0 || depth <= 0.0)
        discard;
    const vec3 direction = mat3(eye.tangent, eye.bitangent, eye.normal) * ray;
    const vec3 look = look_at(eye.position + direction / nearness);
    const Meeting met = meet(p.passage, base_color, look, eye.channel, gl_FragCoord.xy,
                             depth, eye.random);
    if (!met.blocked)
        discard;
    gl_FragDepth = depth;
}
