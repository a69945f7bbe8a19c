#pragma once
// Layout of views as tiles of one image.

#include <algorithm>
#include <cstdint>

#include "gpu/commands.h"

namespace lumel {

/// Number of columns for a nearly square layout of `count` tiles, at most `fit`.
inline std::uint32_t tile_columns(std::uint32_t count, std::uint32_t fit)
{
    std::uint32_t columns = 1;
    while (columns * columns < count)
        ++columns;
    return std::min(columns, fit);
}

/// Number of tiles in the image, including unused ones.
inline std::uint64_t tiles_about_square(std::uint32_t count)
{
    const std::uint64_t columns = tile_columns(count, std::max(count, 1u));
    return columns * ((count + columns - 1) / columns);
}

/// Tiles of one size in rows.
struct Tiles {
    std::uint32_t width, height;  ///< tile size [pixels]
    std::uint32_t columns;        ///< tiles per row of the image

    /// Number of rows for `count` tiles.
    std::uint32_t rows(std::uint32_t count) const { return (count + columns - 1) / columns; }
    /// Number of tiles, at most `count`, in an image of maximum height `side` [pixels]; at least a
    /// row.
    std::uint32_t fitting(std::uint32_t count, std::uint32_t side) const
    {
        return std::min(count, columns * std::max(side / height, 1u));
    }
    /// Size of the image of `count` tiles [pixels].
    std::uint32_t image_width() const { return columns * width; }
    std::uint32_t image_height(std::uint32_t count) const { return rows(count) * height; }
    /// Area of a tile.
    gpu::Area area(std::uint32_t tile) const
    {
        return {tile % columns * width, tile / columns * height, width, height};
    }
};

}  // namespace lumel
