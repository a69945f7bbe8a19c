#pragma once
// The sky and the sun of a cloudless day.

#include "scene/sky/sun.h"
#include "scene/values/scene.h"

namespace lumel {

/// Half the angle that the sun's disc takes in the sky [rad], on average over the year.
inline constexpr float kSunAngle = 0.00465f;  // 0.2665°

/// Illuminance [lx] of a horizontal plane under the open clear sky, without the sun. [IES84];
/// 0 while the sun is below the horizon.
double clear_sky_illuminance(double elevation);

/// Illuminance [lx] of a plane that faces the sun, by the sun alone. [IES84]; 0 below the horizon.
double sun_illuminance(double elevation);

/// The clear sky as an image; black below the horizon, and everywhere while the sun is there. A
/// horizontal plane under it has clear_sky_illuminance.
Sky clear_sky(const SunPosition& sun);

/// The sun as a directional light, white.
PunctualLight sun_light(const SunPosition& sun);

}  // namespace lumel
