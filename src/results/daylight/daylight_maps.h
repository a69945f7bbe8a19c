#pragma once
// Maps of the daylight of a few hours, of which the light of all hours of a year is a sum.

#include <vector>

#include "atlas/prepare/solve_scene.h"
#include "base/core/progress_callback.h"
#include "links/direct/solutions.h"
#include "results/daylight/daylight_year.h"

namespace lumel {

/// Error of the sums, relative to the light of the hour; see ChosenHours.
inline constexpr double kMapsError = 0.01;
inline constexpr std::size_t kMostDaylightMaps = 48;

/// Light of the sky, and of the sun after one reflection and more: its direct light has
/// edges that move with it, which no sum of a few maps has.
struct DaylightMaps {
    std::vector<std::size_t> hours;  ///< [K] of the year: those of the maps
    std::vector<Estimates> light;    ///< [K][N] irradiance [lx]
    std::vector<float> weights;      ///< [hours of the year][K], of any sign
    std::vector<double> mean;        ///< [hours of the year] mean over all surfaces [lx]
    /// [N] Weights of lumels in errors, see error_weights.h.
    std::vector<float> lumel_weights;
    double error = 0.0;  ///< that is due to the number of maps, as in ChosenHours
    /// [hours of the year] Estimated error by that, by the positions of the sun and by rays,
    /// relative to the hour's light.
    std::vector<double> errors;
};

/// Host memory of daylight_maps() and of finished maps of its result, about [bytes]. places: of the
/// sun; scene_bytes: of the scene with its trees and charts, which is copied.
std::uint64_t daylight_map_bytes(const SolveScene& scene, std::size_t places,
                                 std::uint64_t scene_bytes);

/// options: of the scene's atlas; a coarser one decides on the hours. Throws Error{input} without
/// OpenBLAS.
DaylightMaps daylight_maps(const SolveScene& scene, const AtlasOptions& options,
                           const DaylightYear& year, std::uint32_t seed,
                           const ProgressCallback& progress = {});

}  // namespace lumel
