#pragma once
// Sizes that determine a solver's memory.

#include <cstddef>
#include <cstdint>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Sizes beside the options.
struct SolveSize {
    const Lumels* lumels = nullptr;
    std::uint64_t near_pairs = 0;  ///< entries of the near-field table
    float diagonal = 0.0f;         ///< diagonal of the scene's bounding box [m]

    std::size_t count() const { return lumels->lumels.size(); }  ///< N
    std::uint64_t texels() const { return std::uint64_t(lumels->width) * lumels->height; }
};

}  // namespace lumel
