#pragma once
// Stopping criteria of a solve.

#include <cstdint>

namespace lumel {

/// The limits of SolverOptions, without the method.
struct SolveLimits {
    std::uint64_t max_shots = 0;     ///< 0: no limit
    double max_seconds = 0.0;        ///< 0: no limit
    double target_error = 0.0;       ///< estimated relative error; 0: not used
    double target_dark_error = 0.0;  ///< estimated relative error of dark lumels; 0: not used
    double target_eye_error = 0.0;   ///< SolverState::eye_error; 0: not used
    std::uint64_t max_bytes = 0;     ///< host memory limit of links, 0: no limit
};

}  // namespace lumel
