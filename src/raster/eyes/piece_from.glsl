#ifndef LUMEL_VISIBILITY_PIECE_FROM_GLSL
#define LUMEL_VISIBILITY_PIECE_FROM_GLSL

// Pieces of lumels in a hemicube face.

#include "atlas/packing/lumel.shared.h"
#include "raster/world/first_met.glsl"
#include "raster/eyes/pixels.glsl"

// Relative rounding error of stored depths.
const float kHemicubeRounding = 2e-5;

// `f`: projection of a point of the piece. `frame`: the eye's axes (t, b, n).
PieceInView piece_from(EyeViewLayout tiling, ViewPoint f, vec3 eye, mat3 frame, Piece piece)
{
    const vec3 o = (piece.origin - eye) * frame, u = piece.edge_u * frame, v = piece.edge_v * frame;
    // The ray t q intersects the plane o + a u + b v at  a = q·(v×o) / q·(u×v), b = q·(o×u) /
    // q·(u×v),  t = o·(u×v) / q·(u×v). q is linear in the pixel position.
    const vec3 start = centre_ray(tiling, f, vec2(-0.5));
    const vec3 right = centre_ray(tiling, f, vec2(0.5, -0.5)) - start;
    const vec3 up = centre_ray(tiling, f, vec2(-0.5, 0.5)) - start;
    const mat3 rays = mat3(right, up, start);
    const vec3 normal = cross(u, v);
    PieceInView s;
    s.u_form = cross(v, o) * rays;
    s.v_form = cross(o, u) * rays;
    s.weight = normal * rays;
    s.depth_form = s.weight * (tiling.near / dot(o, normal));
    const vec3 p = vec3(f.at, 1.0);
    s.steepness = (abs(s.weight.x) + abs(s.weight.y)) / abs(dot(s.weight, p)) / length(right);
    s.rounding = kHemicubeRounding * dot(s.depth_form, p);
    // Positive weights for an eye in front: then normal·o < 0 and normal·q < 0.
    if (dot(o, normal) < 0.0) {
        s.u_form = -s.u_form;
        s.v_form = -s.v_form;
        s.weight = -s.weight;
    }
    s.parallelogram = piece.parallelogram != 0u;
    return s;
}

#endif
