#pragma once
// When a solve stops.

#include <cstdint>

namespace lumel {

/// Each limit of SolverOptions, without the method.
struct SolveLimits {
    std::uint64_t max_shots = 0;     ///< 0: no limit
    double max_seconds = 0.0;        ///< 0: no limit
    double target_error = 0.0;       ///< estimated relative error, 0: never
    double target_dark_error = 0.0;  ///< estimated relative error of dark lumels, 0: never
    std::uint64_t max_bytes = 0;     ///< host memory that links may take, 0: no limit
};

}  // namespace lumel
