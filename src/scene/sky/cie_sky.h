#pragma once
// The skies of the CIE, of which the overcast ones define daylight factors.

#include <optional>

#include "scene/sky/sun.h"
#include "scene/values/sky.h"

namespace lumel {

/// Illuminance of an open horizontal plane by default [lx].
inline constexpr float kCieLux = 10'000.0f;
/// Types are numbered from 1 to this, the traditional overcast sky.
inline constexpr int kOvercastType = 16;

struct CieSky {
    int type = kOvercastType;
    float lux = kCieLux;             ///< illuminance of an open horizontal plane facing up [lx]
    std::optional<SunPosition> sun;  ///< where the sky is brightest; its own light is not included
};

/// True for the overcast skies, 1 (standard) and 16: under both, daylight factors are defined.
bool is_overcast(int type);

/// True if the luminance depends on the sun's place.
bool depends_on_sun(int type);

/// Luminance, in any unit. cos_zenith: of the angle from the zenith, above 0; from_sun: angle
/// [rad].
double cie_luminance(int type, double cos_zenith, double from_sun);

/// White, black below the horizon. sky.sun is required if the type depends on it.
Sky image_of(const CieSky& sky);

}  // namespace lumel
