#pragma once
// Luminance of the sky in any weather, by radiation of the sun and of the sky.

#include <array>

#include <glm/glm.hpp>

#include "scene/sky/sun.h"

namespace lumel {

/// Radiation of an hour.
struct Radiation {
    double direct = 0.0;   ///< of the sun on a plane that faces it [W/m²]
    double diffuse = 0.0;  ///< of the sky on a horizontal plane [W/m²]; above 0 if direct is 0
    int day_of_year = 1;
    double dew_point = 0.0;  ///< [°C]
};

/// The sky of [PSM93] and the luminous efficacy of [PISMS90]. A sun below the horizon counts as on
/// it; clearness and brightness are kept within the bounds of the data.
class PerezSky {
public:
    PerezSky(const Radiation& radiation, const SunPosition& sun);

    double clearness() const { return clearness_; }    ///< ε, 1: no sun
    double brightness() const { return brightness_; }  ///< Δ

    /// Luminance in any unit. cos_zenith: of the angle from the zenith, above 0; from_sun: angle
    /// [rad].
    double luminance(double cos_zenith, double from_sun) const;
    double diffuse_efficacy() const;  ///< [lm/W]
    double direct_efficacy() const;   ///< [lm/W]

private:
    double zenith_, clearness_, brightness_, water_;
    std::size_t bin_;
    double a_, b_, c_, d_, e_;
};

}  // namespace lumel
