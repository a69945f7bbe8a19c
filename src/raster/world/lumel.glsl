#ifndef LUMEL_WORLD_LUMEL_GLSL
#define LUMEL_WORLD_LUMEL_GLSL

// Lumels in the world, and points on them. Declares `lumels` and `pieces`. Duplicates
// atlas/lumels/sampling.h.

#include "atlas/packing/lumel.shared.h"

layout(scalar) readonly buffer Lumels { Lumel lumels[]; };
layout(scalar) readonly buffer Pieces { Piece pieces[]; };

struct LumelPoint {
    vec3 position;
    vec3 normal;  // shading normal, unit
    vec3 facing;  // geometric normal, any length
    uint piece;   // index of its piece
};

// Maps (s, t) in the unit square to a point of the lumel, uniform by area.
LumelPoint point_on(Lumel lumel, float s, float t)
{
    uint index = lumel.first_piece;
    const uint last = lumel.first_piece + lumel.piece_count - 1u;
    float below = 0.0;
    while (index < last && s >= pieces[index].share)
        below = pieces[index++].share;
    const Piece piece = pieces[index];
    const float width = piece.share - below;
    float u = width > 0.0 ? clamp((s - below) / width, 0.0, 1.0) : 0.5;
    float v = t;
    if (piece.parallelogram == 0u && u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return LumelPoint(piece.origin + u * piece.edge_u + v * piece.edge_v, piece.normal,
                      cross(piece.edge_u, piece.edge_v), index);
}

#endif
