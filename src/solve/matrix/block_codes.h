#pragma once
// Texture blocks of 4 × 4 texels as graphics hardware reads them: BC1 (DXT1) for three channels,
// BC4 for one. A texel's channel is 0…255.

#include <array>
#include <cstdint>

namespace lumel {

inline constexpr std::uint32_t kBlockSide = 4;
inline constexpr std::uint32_t kBlockTexels = kBlockSide * kBlockSide;

/// As they lie in memory: low word first.
using BlockWords = std::array<std::uint32_t, 2>;

/// [row][column][channel]
using ColorBlock = std::array<std::array<float, 3>, kBlockTexels>;
/// [row][column]
using GrayBlock = std::array<float, kBlockTexels>;

/// Endpoints by the principal axis of the texels, then refined by least squares.
BlockWords encode_bc1(const ColorBlock& texels);
ColorBlock decode_bc1(const BlockWords& words);

/// Endpoints from the range of the texels (with and without those that are 0), then refined.
BlockWords encode_bc4(const GrayBlock& texels);
GrayBlock decode_bc4(const BlockWords& words);

}  // namespace lumel
