#pragma once
// What the memory that a solver takes depends on.

#include <cstddef>
#include <cstdint>

#include "atlas/packing/atlas.h"

namespace lumel {

/// Beside the options.
struct SolveSize {
    const Lumels* lumels = nullptr;
    std::uint64_t near_pairs = 0;  ///< of the near field, as many as its table has
    float diagonal = 0.0f;         ///< of the scene's bounding box [m]

    std::size_t count() const { return lumels->lumels.size(); }  ///< N
    std::uint64_t texels() const { return std::uint64_t(lumels->width) * lumels->height; }
};

}  // namespace lumel
