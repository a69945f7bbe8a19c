#pragma once
// Fills texels from their neighbours.

#include <cstdint>
#include <vector>

#include "base/core/image.h"

namespace lumel {

enum class TexelState : std::uint8_t {
    known,    ///< has a value
    wanted,   ///< receives a value from its neighbours
    outside,  ///< neither reads nor is read
};

/// Fills wanted texels ring by ring, outwards from the known ones: the RGB of a texel is the
/// mean of its eight neighbours known before the ring. Only neighbours of equal label count, if
/// `labels` is not empty. states [height][width].
void grow(Image& map, std::vector<TexelState> states, const std::vector<std::uint32_t>& labels);

}  // namespace lumel
