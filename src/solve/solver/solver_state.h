#pragma once
// Where a solver stands.

#include <cstdint>

namespace lumel {

/// As last read back from the device.
struct SolverState {
    std::uint64_t shots = 0;       ///< shooters so far, or what else MethodInfo::shots names
    std::uint64_t iterations = 0;  ///< steps so far
    double error = -1.0;  ///< estimated relative RMSE of the irradiance, < 0: not known yet
    /// The same of lumels below a third of the mean, relative to their own; < 0: not known.
    double dark_error = -1.0;
    bool full = false;   ///< there is no memory for more: further steps change nothing
    double begun = 0.0;  ///< how far it is on the way to its first estimate, 0…1, where it knows
};

}  // namespace lumel
