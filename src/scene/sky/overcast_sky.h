#pragma once
// The CIE overcast sky, by which daylight factors are defined.

#include "scene/values/sky.h"

namespace lumel {

/// What it gives an open horizontal plane if nothing else is asked for [lx].
inline constexpr float kOvercastLux = 10'000.0f;

/// White, alike in all azimuths, three times as bright at the zenith as at the horizon, black below
/// it. lux: of an open horizontal plane that faces up.
Sky overcast_sky(float lux);

}  // namespace lumel
