#pragma once
// Sky and sun of a cloudless day.

#include "scene/sky/sun.h"
#include "scene/values/scene.h"

namespace lumel {

/// Angular radius of the sun [rad], averaged over the year.
inline constexpr float kSunAngle = 0.00465f;  // 0.2665°

/// Illuminance [lx] of a horizontal plane under the clear sky, without the sun. [IES84]; 0 while
/// the sun is below the horizon.
double clear_sky_illuminance(double elevation);

/// Illuminance [lx] by the sun alone, of a plane facing it. [IES84]; 0 below the horizon.
double sun_illuminance(double elevation);

/// The clear sky as an image: black below the horizon, and everywhere while the sun is there. Its
/// irradiance on a horizontal plane is clear_sky_illuminance.
Sky clear_sky(const SunPosition& sun);

/// The sun as a directional light, white.
PunctualLight sun_light(const SunPosition& sun);

}  // namespace lumel
