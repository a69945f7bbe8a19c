#pragma once
// One side of a chart, as the filter reads it.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/lumel.shared.h"

namespace lumel {

/// Steps from a lumel to four of its eight neighbours; the other four are reversed.
struct Offset {
    int x, y;
};
inline constexpr std::array<Offset, 4> kSteps = {{{1, 0}, {0, 1}, {1, 1}, {-1, 1}}};

/// Two neighbours can be separated by geometry that is closer than this multiple of their distance;
/// a ray between them, kLift sides of a lumel above them, decides.
inline constexpr float kMayStandBetween = 1.5f, kLift = 0.05f;

/// Lumels of one side of a chart in a grid of texels, row by row.
struct FilterChart {
    int width = 0, height = 0;
    std::vector<std::uint32_t> lumel;  ///< kNoLumel: none, or it takes no part
    std::vector<std::uint8_t> steps;   ///< bit s: the filter may step over kSteps[s]
    std::vector<glm::vec3> normal;     ///< unit
    /// Side of a lumel / harmonic mean of the distances that its rays go.
    std::vector<float> nearness;

    std::size_t at(int x, int y) const
    {
        return std::size_t(y) * std::size_t(width) + std::size_t(x);
    }
};

}  // namespace lumel
