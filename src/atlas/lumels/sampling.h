#pragma once
// Points on lumels, on the CPU. Duplicated in raster/world/lumel.glsl.

#include <algorithm>
#include <cmath>
#include <span>

#include "atlas/packing/atlas.h"

namespace lumel {

/// A point of a lumel and its normal, in the frame of its pieces.
struct LumelPoint {
    glm::vec3 position;
    glm::vec3 normal;
};

/// Maps (u, v) in the unit square to a point of a piece, uniform by area.
inline LumelPoint point_in(const Piece& piece, float u, float v)
{
    if (piece.parallelogram == 0 && u + v > 1.0f) {
        u = 1.0f - u;
        v = 1.0f - v;
    }
    return {piece.origin + u * piece.edge_u + v * piece.edge_v, piece.normal};
}

/// Maps (s, t) in the unit square to a point of the lumel with these pieces, uniform by area.
inline LumelPoint point_on(std::span<const Piece> pieces, float s, float t)
{
    // Selects the piece by its share of the area, and rescales s to 0…1.
    std::size_t index = 0;
    float below = 0.0f;
    while (index + 1 < pieces.size() && s >= pieces[index].share)
        below = pieces[index++].share;
    const Piece& piece = pieces[index];
    const float width = piece.share - below;
    return point_in(piece, width > 0.0f ? std::clamp((s - below) / width, 0.0f, 1.0f) : 0.5f, t);
}

/// Maps (s, t) to a point in the lumel's instance frame.
inline LumelPoint point_on(const Lumels& lumels, const Lumel& lumel, float s, float t)
{
    return point_on(std::span(lumels.pieces).subspan(lumel.first_piece, lumel.piece_count), s, t);
}

}  // namespace lumel
