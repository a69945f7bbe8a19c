#pragma once
// The options of one method, and when a solve stops.

#include <cstdint>
#include <variant>

#include "links/trace/links_options.h"
#include "methods/directions/options.h"
#include "methods/gather/options.h"
#include "methods/glossy/options.h"
#include "methods/matrix/options.h"
#include "methods/progressive/options.h"
#include "methods/stochastic/options.h"
#include "solve/solver/solve_limits.h"

namespace lumel {

using MethodOptions =
    std::variant<LinksOptions, StochasticOptions, GlossyOptions, DirectionsOptions,
                 ProgressiveOptions, GatherOptions, MatrixOptions>;

/// Of a map whose noise is seen, is hard to see, and is not seen.
inline constexpr Quality kDraft{.visible_noise = 0.01, .eye_error = 0.1},
    kGood{.visible_noise = 0.005, .eye_error = 0.05},
    kFine{.visible_noise = 0.002, .eye_error = 0.02};

/// Rays per lumel after which a bake by links ends unless a limit is asked for: from there on
/// visible noise falls slowly, in a Blender room from 0.75 to 0.53 % between 64 and 128 rays.
inline constexpr std::uint64_t kDefaultRays = 96;

/// A method, and when to stop.
struct SolverOptions {
    MethodOptions method = LinksOptions{};
    std::uint64_t max_shots = 0;         ///< 0: no limit
    double max_seconds = 0.0;            ///< 0: no limit. Of a bake: from its beginning
    double target_error = 0.02;          ///< estimated relative error to stop at, 0: never
    double target_dark_error = 0.0;      ///< estimated relative error of dark lumels, 0: never
    Quality target_quality;              ///< to stop at
    std::uint64_t max_bytes = 0;         ///< host memory that links may take, 0: no limit
    std::uint64_t max_device_bytes = 0;  ///< GPU memory that sweeps may take, 0: no limit

    bool has_target() const
    {
        return target_error > 0.0 || target_dark_error > 0.0 || target_quality.is_given();
    }
    /// True with the limits of a bake by links that is asked for nothing.
    bool has_default_limits() const
    {
        return max_shots == kDefaultRays && target_quality == kGood && max_seconds == 0.0 &&
               target_error == 0.0 && target_dark_error == 0.0;
    }
    SolveLimits limits() const
    {
        return {max_shots,      max_seconds, target_error,    target_dark_error,
                target_quality, max_bytes,   max_device_bytes};
    }
};

/// Sets the targets and limits of a bake that is asked for none.
void set_default_limits(SolverOptions& options);

// Options that most methods have, with a substitute for the others.

inline std::uint32_t seed_of(const MethodOptions& method)
{
    return std::visit([](const auto& options) { return options.seed; }, method);
}

/// SampleRule::area for methods without this option.
SampleRule rule_of(const MethodOptions& method);

/// Common defaults for methods without views from lumels.
ViewOptions views_of(const MethodOptions& method);

/// K, shooters per step; 0 for methods without shooters.
int batch_of(const MethodOptions& method);

/// True for the papers' iteration, which has no near field.
bool is_papers(const MethodOptions& method);

}  // namespace lumel
