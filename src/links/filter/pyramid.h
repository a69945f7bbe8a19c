#pragma once
// Filters a chart by a pyramid of local fits, joined by gains that independent estimates tell.
//
// [CPD07] J. Chen, S. Paris, F. Durand. Real-Time Edge-Aware Image Processing with the Bilateral
//         Grid. SIGGRAPH 2007.
// [RKZ11] F. Rousselle, C. Knaus, M. Zwicker. Adaptive Sampling and Reconstruction using Greedy
//         Error Minimization. SIGGRAPH Asia 2011.
// [WH92] G. Ward, P. Heckbert. Irradiance Gradients. Eurographics Workshop on Rendering 1992.

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "links/filter/fit_level.h"
#include "links/filter/outliers.h"

namespace lumel {

/// How the pyramid joins its levels.
struct PyramidRule {
    /// [levels] Multiple of the noise that is subtracted from the signal, from the finest level on.
    std::span<const float> caution;
    /// Bounds the signal by the harmonic mean distance of ray hits [WH92].
    bool is_bounded;
    /// Deviation of the window of few cells in which a detail can stand out of the noise [cells]:
    /// lumels with many rays beside noisy ones.
    float noise_spread;
    /// Averages noise over that window alone: beside a noisy penumbra, lumels that see all of the
    /// light or none of it are exact.
    bool has_local_noise;
    /// Shares outliers, and keeps no detail of a single cell: rays of one or of all estimates may
    /// have met a small light by chance.
    bool doubts_single_cells;
};

/// Indirect light, which varies over distances like those to its senders; and direct light, whose
/// shadows can be sharp anywhere.
PyramidRule rule_of_indirect();
PyramidRule rule_of_direct();

/// [levels][texels] β of filter_chart.
using PyramidGains = std::vector<std::vector<float>>;

template <std::size_t Count>
struct Filtered {
    std::vector<FitLight<Count>> light;  ///< [texels]
    Outliers outliers;                   ///< shared first, of indirect light
    PyramidGains gains;
};

/// Filtered estimates at each texel of the chart. With E_0 the light of lumels and E_l the fits of
/// level l, and details d_l = E_{l-1} - E_l: E_n + Σ β_l d_l, with gains
///
///     β = S / (S + ν),    S = T - caution · ν,
///     T = mean over pairs d_a · d_b,    ν = |mean d|² - T
///
/// T is signal, as noise of different estimates is independent, and ν the noise of their mean, both
/// averaged over cells nearby, of indirect light over those as far from other geometry [CPD07]; ν
/// of direct light over the next cells only: an empirical Wiener filter. On the two finest
/// levels T leaves out the strongest cell. β is at least that of the next cells alone, with a
/// caution of 3, or of 5 where there is no signal around, and of indirect light without that cell.
/// All estimates have the same gains.
template <std::size_t Count>
Filtered<Count> filter_chart(const FilterChart& chart,
                             const std::array<const Estimates*, Count>& found,
                             const PyramidRule& rule);

/// Other light, of up to this many kinds at once, filtered by the outliers and gains that
/// filter_chart found: parts of a light so filtered add up to the filtered light.
inline constexpr std::size_t kFilteredTogether = 8;
std::vector<FitLight<kFilteredTogether>>
filter_chart_by(const Outliers& outliers, const PyramidGains& gains, const FilterChart& chart,
                const std::array<const Estimates*, kFilteredTogether>& found);

}  // namespace lumel
