#pragma once
// Texture blocks made for the codes themselves: BC1 for three channels, BC4 for one.

#include "solve/matrix/bc1_blocks.h"

namespace lumel::bench {

/// [row][column]
using GrayBlock = std::array<float, kBlockTexels>;

/// Endpoints by the principal axis of the texels, then refined by least squares.
BlockWords encode_bc1(const ColorBlock& texels);

/// Endpoints from the range of the texels (with and without those that are 0), then refined.
BlockWords encode_bc4(const GrayBlock& texels);
GrayBlock decode_bc4(const BlockWords& words);

}  // namespace lumel::bench
