#pragma once
// The CIE overcast sky, which defines daylight factors.

#include "scene/values/sky.h"

namespace lumel {

/// Default illuminance of an open horizontal plane [lx].
inline constexpr float kOvercastLux = 10'000.0f;

/// White, independent of azimuth, three times as bright at the zenith as at the horizon, black
/// below it. lux: illuminance of an open horizontal plane facing up.
Sky overcast_sky(float lux);

}  // namespace lumel
