#ifndef LUMEL_VISIBILITY_PIECE_ALONG_GLSL
#define LUMEL_VISIBILITY_PIECE_ALONG_GLSL

// Pieces of lumels in parallel views.

#include "atlas/packing/lumel.shared.h"
#include "raster/world/first_met.glsl"
#include "raster/parallel/parallel.glsl"

// Rounding error of stored depths in 0…1, for a scene near the origin.
const float kParallelRounding = 1e-6;

PieceInView piece_along(ParallelView view, Piece piece)
{
    const vec2 origin = place_in(view, piece.origin);
    const vec2 u = vec2(dot(view.right, piece.edge_u), dot(view.up, piece.edge_u));
    const vec2 v = vec2(dot(view.right, piece.edge_v), dot(view.up, piece.edge_v));
    const float per_area = 1.0 / (u.x * v.y - u.y * v.x);
    PieceInView s;
    s.u_form = vec3(v.y, -v.x, origin.y * v.x - origin.x * v.y) * per_area;
    s.v_form = vec3(-u.y, u.x, origin.x * u.y - origin.y * u.x) * per_area;
    s.weight = vec3(0.0, 0.0, 1.0);
    const float along_u = dot(view.toward, piece.edge_u), along_v = dot(view.toward, piece.edge_v);
    s.depth_form = along_u * s.u_form + along_v * s.v_form;
    s.depth_form.z += nearness_in(view, piece.origin);
    s.steepness = (abs(s.depth_form.x) + abs(s.depth_form.y)) * length(view.right) /
                  length(view.toward);
    s.rounding = kParallelRounding * max(1.0, abs(view.depth_shift));
    s.parallelogram = piece.parallelogram != 0u;
    return s;
}

#endif
