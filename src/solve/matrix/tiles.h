#pragma once
// Tiles of 4 × 4 numbers, in codes of a few bits.

#include <array>
#include <cstdint>
#include <vector>

#include "solve/matrix/tiles.shared.h"

namespace lumel {

inline constexpr std::size_t kTileTexels = std::size_t(kTile) * kTile;

/// By precision.
inline constexpr std::array<std::uint32_t, kPrecisions> kTileBits = {4, 8, 16};
inline constexpr std::array<float, kPrecisions> kTileCodes = {kCodes4, kCodes8, kCodes16};

/// [row][column]
using Tile = std::array<float, kTileTexels>;

/// A tile's codes, and what the largest means: a half float, in units.
struct CodedTile {
    std::uint16_t scale = 0;
    std::array<int, kTileTexels> code{};
};

CodedTile encode(const Tile& tile, float unit, std::size_t precision);
Tile decode(const CodedTile& coded, float unit, std::size_t precision);

/// Tiles of one precision, row by row.
struct TileRows {
    std::vector<std::uint32_t> first;  ///< [tile rows + 1]
    /// Upper 16 bits: half float, what the largest code means; lower: the tile's column.
    std::vector<std::uint32_t> place;
    std::vector<std::uint32_t> codes;  ///< per tile: 16 of kTileBits each, row by row

    /// For StateWriter and StateReader.
    template <class Archive>
    void state(Archive& archive)
    {
        archive(first, place, codes);
    }
};

/// Adds a tile to the row that is being filled.
void append(TileRows& rows, const CodedTile& tile, std::size_t column, std::size_t precision);

/// The tile of that number.
CodedTile tile_at(const TileRows& rows, std::size_t tile, std::size_t precision);

/// Of tiles with column ≤ row, these and their mirror images.
TileRows with_mirror_images(const TileRows& below, std::size_t precision);

}  // namespace lumel
