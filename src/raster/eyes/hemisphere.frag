#version 460
#include "raster/eyes/eye_views.shared.h"
#include "raster/eyes/hemisphere.glsl"

// Exact distance of the triangle's plane along the ray through the pixel's centre; no function of
// the distance is linear on the disc.

layout(push_constant, scalar) uniform Params { LookParams p; };
layout(location = 0) flat in vec3 plane;

void main()
{
    const vec3 ray = ray_through(gl_FragCoord.xy - vec2(p.corner), p.radius);
    const float depth = p.near * dot(plane, ray);
    if (depth > 1.0)
        discard;
    gl_FragDepth = max(depth, 0.0);
}
