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

/// True if the filter may step over (dx, dy) from one place to the next. steps: of each place, bit
/// s: it may step over kSteps[s].
inline bool has_step(const std::vector<std::uint8_t>& steps, std::size_t from, std::size_t to,
                     int dx, int dy)
{
    for (std::size_t s = 0; s < kSteps.size(); ++s) {
        if (kSteps[s].x == dx && kSteps[s].y == dy)
            return (steps[from] >> s & 1u) != 0;
        if (kSteps[s].x == -dx && kSteps[s].y == -dy)
            return (steps[to] >> s & 1u) != 0;
    }
    return false;
}

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
    bool contains(int x, int y) const { return x >= 0 && x < width && y >= 0 && y < height; }
    /// True if the filter may step from a lumel to the one at (dx, dy).
    bool is_open(int x, int y, int dx, int dy) const
    {
        return contains(x + dx, y + dy) && has_step(steps, at(x, y), at(x + dx, y + dy), dx, dy);
    }
};

}  // namespace lumel
