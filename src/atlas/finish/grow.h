#pragma once
// Filling texels from their neighbours.

#include <cstdint>
#include <vector>

#include "base/core/image.h"

namespace lumel {

enum class TexelState : std::uint8_t {
    known,    ///< has its value
    wanted,   ///< takes one from its neighbours
    outside,  ///< neither gives nor takes
};

/// Fills wanted texels ring by ring, outwards from the known ones: RGB of a ring's texel is the
/// mean of those of its eight neighbours that were known before the ring. Light passes only
/// between texels of equal label; `labels` empty: between all. states [height][width].
void grow(Image& map, std::vector<TexelState> states, const std::vector<std::uint32_t>& labels);

}  // namespace lumel
