#pragma once
// Both sides of double-sided surfaces in the map. In solvers both lumels have the front's texel
// (Lumel::texel); the map may have separate texels for the back.

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

/// Index of a texel and side in lumels_by_side().
inline std::size_t place_by_side(std::size_t texel, bool back)
{
    return 2 * texel + (back ? 1 : 0);
}

inline std::size_t place_by_side(const Lumel& lumel)
{
    return place_by_side(lumel.texel, is_back(lumel));
}

/// [lumels of `from`] The lumel of `to` at the same texel and side, or kNoLumel. Both are of one
/// atlas, or of parts of it.
std::vector<std::uint32_t> lumels_alike(const Lumels& from, const Lumels& to);

/// [lumels of `to`] The values [lumels of `from`] at the same texel and side; zero without
/// any, as all are if there are no values.
template <class Value>
std::vector<Value> carried(const std::vector<Value>& values, const Lumels& from, const Lumels& to)
{
    std::vector<Value> result(to.lumels.size(), Value(0));
    const std::vector<std::uint32_t> alike = lumels_alike(from, to);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (alike[i] != kNoLumel)
            result[alike[i]] = values[i];
    return result;
}

/// [N] 1: buried.
std::vector<char> buried_of(const Lumels& lumels);

/// The lumels, with those buried that `buried` [N] says, and no others.
Lumels with_buried(Lumels lumels, const std::vector<char>& buried);

/// The lumel at a texel and side (0: front, 1: back), by lumels_by_side(). kNoLumel if there is
/// none that can receive light.
inline std::uint32_t lit_lumel_at(const Lumels& lumels, std::span<const std::uint32_t> by_side,
                                  int x, int y, int side)
{
    if (x < 0 || x >= lumels.width || y < 0 || y >= lumels.height)
        return kNoLumel;
    const std::size_t texel = std::size_t(y) * std::size_t(lumels.width) + std::size_t(x);
    const std::uint32_t i = by_side[place_by_side(texel, side != 0)];
    return i == kNoLumel || (lumels.lumels[i].flags & kLumelBuried) ? kNoLumel : i;
}

/// True if the back of a chart has its own texels. back_shift: as in Atlas.
bool has_own_back(std::span<const glm::ivec2> back_shift, std::uint32_t chart);

/// True if one of the surface's charts has a back with its own texels.
bool has_own_back(const Atlas& atlas, const Surface& surface);

/// The map texel of a lumel, if it is shown.
std::uint32_t map_texel(const Lumels& lumels, const Lumel& lumel);

/// The map chart of a lumel: backs with their own texels are separate charts, numbered after all
/// others.
std::uint32_t map_chart(const Lumels& lumels, const Lumel& lumel);

/// The back of a surface: reversed triangles with the atlas positions of that side. Vertices
/// correspond one to one.
Surface back_of(const Atlas& atlas, const Surface& surface);

/// The back of a surface without the triangles that share the front's texels.
Surface own_back_of(const Atlas& atlas, const Surface& surface);

}  // namespace lumel
