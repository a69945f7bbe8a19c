#pragma once
// Where the map has the two sides of double-sided surfaces. Solvers know both sides of a lumel by
// one texel, that of the front (Lumel::texel); the map may show the back in texels of its own.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "atlas/packing/atlas.h"

namespace lumel {

inline bool is_back(const Lumel& lumel)
{
    return (lumel.flags & kLumelBack) != 0;
}

/// Where lumels_by_side() has the lumel of a texel and side.
inline std::size_t place_by_side(std::size_t texel, bool back)
{
    return 2 * texel + (back ? 1 : 0);
}

inline std::size_t place_by_side(const Lumel& lumel)
{
    return place_by_side(lumel.texel, is_back(lumel));
}

/// The lumel at a texel and side (0: front, 1: back), by lumels_by_side(). kNoLumel if there is none
/// that can receive light.
inline std::uint32_t lit_lumel_at(const Lumels& lumels, std::span<const std::uint32_t> by_side,
                                  int x, int y, int side)
{
    if (x < 0 || x >= lumels.width || y < 0 || y >= lumels.height)
        return kNoLumel;
    const std::size_t texel = std::size_t(y) * std::size_t(lumels.width) + std::size_t(x);
    const std::uint32_t i = by_side[place_by_side(texel, side != 0)];
    return i == kNoLumel || (lumels.lumels[i].flags & kLumelBuried) ? kNoLumel : i;
}

/// True if the map shows the back of a chart in texels of its own. back_shift: an atlas'.
bool has_own_back(std::span<const glm::ivec2> back_shift, std::uint32_t chart);

/// True if one of the surface's charts has.
bool has_own_back(const Atlas& atlas, const Surface& surface);

/// The texel of the map that shows a lumel, if it is shown.
std::uint32_t map_texel(const Lumels& lumels, const Lumel& lumel);

/// The chart of the map that it belongs to there: backs with texels of their own are charts of
/// their own, numbered after all others.
std::uint32_t map_chart(const Lumels& lumels, const Lumel& lumel);

/// A surface as seen from its back: triangles turned round, with the places where the map shows
/// that side. Its vertices are the surface's, one for one.
Surface back_of(const Atlas& atlas, const Surface& surface);

/// The same without triangles whose sides share their texels.
Surface own_back_of(const Atlas& atlas, const Surface& surface);

}  // namespace lumel
