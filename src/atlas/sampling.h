#pragma once
// Points on lumels, on the host. The twin of world/lumel.glsl.

#include <algorithm>
#include <cmath>
#include <vector>

#include "atlas/atlas.h"

namespace lumel {

/// A point of a lumel and the normal there, instance frame.
struct LumelPoint {
    glm::vec3 position;
    glm::vec3 normal;
};

/// Maps (s, t) in the unit square to a point of the lumel, uniform by area.
inline LumelPoint point_on(const Lumels& lumels, const Lumel& lumel, float s, float t)
{
    // Choose the piece by its share of the area, and stretch s back to 0…1.
    std::uint32_t index = lumel.first_piece;
    float below = 0.0f;
    while (index + 1 < lumel.first_piece + lumel.piece_count && s >= lumels.pieces[index].share)
        below = lumels.pieces[index++].share;
    const Piece& piece = lumels.pieces[index];
    const float width = piece.share - below;
    float u = width > 0.0f ? std::clamp((s - below) / width, 0.0f, 1.0f) : 0.5f;
    float v = t;
    if (piece.parallelogram == 0 && u + v > 1.0f) {
        u = 1.0f - u;
        v = 1.0f - v;
    }
    return {piece.origin + u * piece.edge_u + v * piece.edge_v, piece.normal};
}

}  // namespace lumel
