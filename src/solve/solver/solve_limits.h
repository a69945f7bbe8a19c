#pragma once
// Stopping criteria of a solve.

#include <cstdint>

namespace lumel {

/// Targets for what is seen: of both, 0: not used.
struct Quality {
    double visible_noise = 0.0;  ///< VisibleNoise::worst_chart
    double eye_error = 0.0;      ///< SolverState::eye_error

    bool is_given() const { return visible_noise > 0.0 || eye_error > 0.0; }
    bool operator==(const Quality&) const = default;
};

/// The limits of SolverOptions, without the method.
struct SolveLimits {
    std::uint64_t max_shots = 0;     ///< 0: no limit
    double max_seconds = 0.0;        ///< 0: no limit
    double target_error = 0.0;       ///< estimated relative error; 0: not used
    double target_dark_error = 0.0;  ///< estimated relative error of dark lumels; 0: not used
    Quality target_quality;
    std::uint64_t max_bytes = 0;         ///< host memory limit of links, 0: no limit
    std::uint64_t max_device_bytes = 0;  ///< GPU memory limit of sweeps, 0: no limit
};

}  // namespace lumel
