#pragma once
// Light at lumels in some hours of a year, filtered as that of a bake.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/core/progress_callback.h"
#include "links/direct/solutions.h"
#include "results/daylight/daylight_year.h"

namespace lumel {

struct LightOfHours {
    /// [hours][N] Irradiance by the sky, and by the sun after one reflection and more [lx].
    std::vector<Estimates> light;
    /// [N] Weights of lumels in errors, see error_weights.h.
    std::vector<float> weights;
    /// Estimated error by rays and filter of a typical hour, relative to its light.
    double noise = 0.0;
};

/// Host memory of light_of_hours(), about [bytes].
std::uint64_t light_of_hours_bytes(std::size_t lumels, std::size_t hours);

/// All hours must have light.
LightOfHours light_of_hours(const SolveScene& scene, const DaylightYear& year,
                            std::span<const std::size_t> hours, std::uint32_t seed,
                            const ProgressCallback& progress);

}  // namespace lumel
