#pragma once
// Light at lumels in some hours of a year, filtered as that of a bake.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "links/direct/solutions.h"
#include "results/daylight/daylight_year.h"

namespace lumel {

struct LightOfHours {
    /// [hours][N] Irradiance by the sky, and by the sun after one reflection and more [lx].
    std::vector<Estimates> light;
    /// Estimated error by rays and filter of a typical one, relative to its RMS light.
    double noise = 0.0;
};

/// Host memory of light_of_hours(), about [bytes].
std::uint64_t light_of_hours_bytes(std::size_t lumels, std::size_t hours);

/// Empty if progress, 0…1, returns false. All hours must have light.
std::optional<LightOfHours> light_of_hours(const SolveScene& scene, const DaylightYear& year,
                                           std::span<const std::size_t> hours, std::uint32_t seed,
                                           const std::function<bool(double)>& progress);

}  // namespace lumel
