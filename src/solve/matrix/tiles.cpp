#include "solve/matrix/tiles.h"

#include <algorithm>
#include <cmath>

#include "solve/matrix/half.h"

namespace lumel {
namespace {

float largest_of(const Tile& tile)
{
    float largest = 0.0f;
    for (const float value : tile)
        largest = std::max(largest, std::abs(value));
    return largest;
}

}  // namespace

CodedTile encode(const Tile& tile, float unit, std::size_t precision)
{
    CodedTile coded{.scale = to_half(largest_of(tile) / unit)};
    const float scale = from_half(coded.scale) * unit, codes = kTileCodes[precision];
    if (scale > 0.0f)
        for (std::size_t i = 0; i < kTileTexels; ++i)
            coded.code[i] = int(std::lround(std::clamp(tile[i] / scale, -1.0f, 1.0f) * codes));
    return coded;
}

Tile decode(const CodedTile& coded, float unit, std::size_t precision)
{
    Tile tile;
    const float step = from_half(coded.scale) * unit / kTileCodes[precision];
    for (std::size_t i = 0; i < kTileTexels; ++i)
        tile[i] = float(coded.code[i]) * step;
    return tile;
}

void append(TileRows& rows, const CodedTile& tile, std::size_t column, std::size_t precision)
{
    const std::uint32_t bits = kTileBits[precision];
    const std::size_t per_word = 32 / bits;
    rows.place.push_back(std::uint32_t(tile.scale) << 16 | std::uint32_t(column));
    for (std::size_t i = 0; i < kTileTexels; i += per_word) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < per_word; ++k)
            word |= (std::uint32_t(tile.code[i + k]) & ((1u << bits) - 1u)) << (k * bits);
        rows.codes.push_back(word);
    }
}

CodedTile tile_at(const TileRows& rows, std::size_t tile, std::size_t precision)
{
    const std::uint32_t bits = kTileBits[precision];
    const std::size_t per_word = 32 / bits;
    CodedTile coded{.scale = std::uint16_t(rows.place[tile] >> 16)};
    for (std::size_t i = 0; i < kTileTexels; ++i) {
        const std::size_t at = tile * kTileTexels + i;
        const auto shift = 32 - bits * std::uint32_t(at % per_word + 1);
        coded.code[i] = int(rows.codes[at / per_word] << shift) >> (32 - bits);  // with its sign
    }
    return coded;
}

TileRows with_mirror_images(const TileRows& below, std::size_t precision)
{
    struct Source {
        std::uint32_t column, tile;
        bool mirrored;
    };
    std::vector<std::vector<Source>> rows(below.first.empty() ? 0 : below.first.size() - 1);
    for (std::uint32_t row = 0; row < rows.size(); ++row)
        for (std::uint32_t tile = below.first[row]; tile < below.first[row + 1]; ++tile) {
            const std::uint32_t column = below.place[tile] & 0xffffu;
            rows[row].push_back({column, tile, false});
            if (column != row)
                rows[column].push_back({row, tile, true});
        }
    TileRows all;
    for (const std::vector<Source>& row : rows) {
        all.first.push_back(std::uint32_t(all.place.size()));
        for (const Source& source : row) {
            CodedTile tile = tile_at(below, source.tile, precision);
            if (source.mirrored)
                for (std::size_t i = 0; i < kTile; ++i)
                    for (std::size_t j = 0; j < i; ++j)
                        std::swap(tile.code[i * kTile + j], tile.code[j * kTile + i]);
            append(all, tile, source.column, precision);
        }
    }
    all.first.push_back(std::uint32_t(all.place.size()));
    return all;
}

}  // namespace lumel
