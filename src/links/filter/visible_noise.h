#pragma once
// Noise as an eye sees it on a plain wall: in bands of size, relative to the light there.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/ranks/ranks.h"
#include "links/filter/mean.h"
#include "solve/solver/solver_state.h"

namespace lumel {

/// Minimum light that noise is relative to, as a fraction of the chart's mean.
inline constexpr float kFaintestAround = 0.02f;

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

/// Mean square of each band, relative to the light.
using NoisePower = std::array<double, VisibleNoise::kBands>;

/// Noise of one side of a chart.
struct ChartNoise {
    std::vector<std::uint32_t> lumels;  ///< that count; none: too few to tell
    std::vector<std::uint32_t> beside;  ///< the chart's other open ones, which the filter mixes in
    double light = 0.0;                 ///< their mean luminance [lx]
    std::vector<NoisePower> power;      ///< by each mean

    template <class Archive>
    void state(Archive& archive)
    {
        archive(lumels, beside, light, power);
    }

    double power_in(std::size_t band) const;
    std::size_t worst_band() const;
};

/// The noise of light on a chart: of lumels at some distance from its rim and from blocked ones.
/// Each band is a difference of two Gaussian means, of 1 and 2, 2 and 4, 4 and 8, 8 and 16 lumels;
/// noise is what solutions differ by, with the squared filter bias that they agree on. light [N]:
/// luminance [lx]. of: means whose errors are independent.
ChartNoise chart_noise(const NoiseChart& chart, const std::vector<float>& light,
                       const std::vector<const Mean*>& of);

/// Of the charts of a scene, the cleanest first, without those that are nearly black or too small
/// to tell. ranks: that share the work; null: none. The other arguments: as in chart_noise().
std::vector<ChartNoise> noise_of_charts(const SolveScene& scene, const std::vector<float>& light,
                                        const std::vector<const Mean*>& of, Ranks* ranks = nullptr);

/// Without charts that are nearly black or too small to tell, the cleanest first.
std::vector<ChartNoise> in_order(std::vector<ChartNoise> charts);

/// The noisiest chart that counts of in_order(), 0 for none: below it are 95 % of all charts, by
/// the roots of their areas, so that the ground around a house does not hide its rooms.
std::size_t worst_that_counts(const std::vector<ChartNoise>& charts);

/// Of in_order() together.
VisibleNoise visible_noise(const std::vector<ChartNoise>& charts);

}  // namespace lumel
