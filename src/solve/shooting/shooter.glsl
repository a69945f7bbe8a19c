#ifndef LUMEL_SHOOTING_SHOOTER_GLSL
#define LUMEL_SHOOTING_SHOOTER_GLSL

// Positions and orientations of shooters.

#include "solve/shooting/low_discrepancy.glsl"
#include "solve/shooting/radiosity.glsl"
#include "raster/eyes/eye_views.shared.h"

// Point in the unit cube for shooter k: independent random numbers, or from a sequence.
vec3 draw_point(uint index, uint stream, uint base_seed, bool random)
{
    const uint seed = hash(hash(base_seed) ^ stream);
    if (!random)
        return low_discrepancy_point(index, seed);
    const uint a = hash(seed ^ hash(index));
    const uint b = hash(a ^ 0x9e3779b9u);
    return vec3(unit_float(a), unit_float(b), unit_float(hash(b ^ 0x9e3779b9u)));
}

// Frame about the normal, rotated by a random angle.
Eye make_eye(vec3 position, vec3 normal, uint random, uint channel)
{
    const vec3 other = abs(normal.x) < 0.5 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    const vec3 t0 = normalize(cross(other, normal));
    const vec3 b0 = cross(normal, t0);
    const float angle = unit_float(random) * 0.5 * kPi;  // a hemicube repeats every quarter turn
    const vec3 t = cos(angle) * t0 + sin(angle) * b0;
    return Eye(position, t, cross(normal, t), normal, random, channel);
}

#endif
