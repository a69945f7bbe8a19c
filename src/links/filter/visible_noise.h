#pragma once
// Noise as an eye sees it on a plain wall: in bands of size, relative to the light there.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "links/filter/mean.h"
#include "solve/solver/solver_state.h"

namespace lumel {

/// Lumels of one side of a chart in a grid of texels, row by row.
struct NoiseChart {
    int width = 0, height = 0;
    std::vector<std::uint32_t> lumel;  ///< kNoLumel: none
    std::vector<char> is_blocked;      ///< 1: partly covered by other geometry

    std::size_t at(int x, int y) const
    {
        return std::size_t(y) * std::size_t(width) + std::size_t(x);
    }
};

/// Noise of one side of a chart.
struct ChartNoise {
    std::size_t lumels = 0;                            ///< that count; 0: too few to tell
    double light = 0.0;                                ///< mean luminance [lx]
    std::array<double, VisibleNoise::kBands> power{};  ///< mean square relative to the light
};

/// The noise of light on a chart: of lumels at some distance from its rim and from blocked ones.
/// Each band is a difference of two Gaussian means, of 1 and 2, 2 and 4, 4 and 8, 8 and 16 lumels;
/// noise is what solutions differ by, with the squared filter bias that they agree on. light [N]:
/// luminance [lx]. of: means whose errors are independent.
ChartNoise chart_noise(const NoiseChart& chart, const std::vector<float>& light,
                       const std::vector<const Mean*>& of);

/// Of all charts together. Those that are nearly black do not count.
VisibleNoise visible_noise(std::vector<ChartNoise> charts);

/// Of a scene. The other arguments: as in chart_noise().
VisibleNoise visible_noise(const SolveScene& scene, const std::vector<float>& light,
                           const std::vector<const Mean*>& of);

}  // namespace lumel
