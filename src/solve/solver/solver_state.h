#pragma once
// Status of a solver.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace lumel {

/// Estimated noise of the light on open surfaces, relative to it: see
/// links/filter/visible_noise.h.
struct VisibleNoise {
    static constexpr std::size_t kBands = 4;
    /// RMS of noise whose size is about 1.5, 3, 6 and 12 lumels
    std::array<double, kBands> bands{};
    /// the largest band of the chart below which 95 % of the charts are, by the roots of their
    /// areas; < 0: unknown, or no chart is large enough
    double worst_chart = -1.0;
};

/// An instance whose light is noisier than asked for.
struct NoisySurface {
    std::uint32_t instance;
    double noise;  ///< largest band of its worst chart
};

/// As last read back from the device.
struct SolverState {
    std::uint64_t shots = 0;       ///< shooters, or the unit that MethodInfo::shots names
    std::uint64_t iterations = 0;  ///< steps
    double error = -1.0;           ///< estimated relative RMSE of the irradiance, < 0: unknown
    /// RMSE of lumels below a third of the mean irradiance, relative to their own mean; < 0:
    /// unknown.
    double dark_error = -1.0;
    /// RMS of errors relative to the light that an eye adapts to at each lumel, see
    /// links/filter/adapted_light.h; < 0: unknown.
    double eye_error = -1.0;
    VisibleNoise visible_noise;  ///< only links
    bool full = false;           ///< memory is exhausted: further steps change nothing
    bool ended = false;          ///< nothing is left to do: further steps change nothing
    double begun = 0.0;          ///< progress to the first estimate, 0…1, if known

    /// worst_chart, or 0 if no chart is large enough to show noise; < 0: unknown.
    double seen_noise() const
    {
        return error < 0.0 ? -1.0 : std::max(visible_noise.worst_chart, 0.0);
    }
};

}  // namespace lumel
