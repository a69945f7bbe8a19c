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
