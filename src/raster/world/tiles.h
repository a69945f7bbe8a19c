#pragma once
// How views lie side by side in one image.

#include <algorithm>
#include <cstdint>

#include "gpu/commands.h"

namespace lumel {

/// Columns in which `count` tiles lie about square, so that the image stays small both ways; at
/// most `fit`.
inline std::uint32_t tile_columns(std::uint32_t count, std::uint32_t fit)
{
    std::uint32_t columns = 1;
    while (columns * columns < count)
        ++columns;
    return std::min(columns, fit);
}

/// Tiles of the image in which `count` lie, those that stay empty among them.
inline std::uint64_t tiles_about_square(std::uint32_t count)
{
    const std::uint64_t columns = tile_columns(count, std::max(count, 1u));
    return columns * ((count + columns - 1) / columns);
}

/// Tiles of one size, row by row.
struct Tiles {
    std::uint32_t width, height;  ///< of each [pixels]
    std::uint32_t columns;        ///< in a row of the image

    /// Rows that `count` tiles take.
    std::uint32_t rows(std::uint32_t count) const { return (count + columns - 1) / columns; }
    /// Of `count` tiles, how many an image holds that may be `side` pixels high; never less than a
    /// row.
    std::uint32_t fitting(std::uint32_t count, std::uint32_t side) const
    {
        return std::min(count, columns * std::max(side / height, 1u));
    }
    /// Of the image that `count` tiles take [pixels].
    std::uint32_t image_width() const { return columns * width; }
    std::uint32_t image_height(std::uint32_t count) const { return rows(count) * height; }
    /// Where a tile lies.
    gpu::Area area(std::uint32_t tile) const
    {
        return {tile % columns * width, tile / columns * height, width, height};
    }
};

}  // namespace lumel
