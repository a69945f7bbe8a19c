#pragma once
// Layout of the five faces of a hemicube in a tile of an image, see eye_views.shared.h.

#include "base/core/error.h"
#include "raster/world/tiles.h"

namespace lumel {

/// side: of the front face [pixels].
inline Tiles hemicube_tiles(std::uint32_t side, std::uint32_t columns)
{
    return {2 * side, 3 * side / 2, columns};
}

/// Area of a face in its hemicube's tile.
inline gpu::Area hemicube_face_area(const gpu::Area& tile, std::uint32_t side, std::uint32_t face)
{
    const std::uint32_t half = side / 2;
    switch (face) {
    case 0:
        return {tile.x, tile.y, side, side};
    case 1:
        return {tile.x + side, tile.y, side, half};
    case 2:
        return {tile.x + side, tile.y + half, side, half};
    case 3:
        return {tile.x, tile.y + side, side, half};
    default:
        return {tile.x + side, tile.y + side, side, half};
    }
}

/// Number of tiles, each 2 × `side` wide, that fit side by side. Throws Error{input} for an invalid
/// side.
inline std::uint32_t fitting_hemicubes(const gpu::Device& device, std::uint32_t side)
{
    const std::uint32_t fit = side > 0 ? device.max_image_side() / (2 * side) : 0;
    if (side < 2 || side % 2 != 0 || fit == 0)
        throw Error(ErrorKind::input, "--hemicube " + std::to_string(side),
                    "must be an even number of pixels that fits the device's images");
    return fit;
}

}  // namespace lumel
