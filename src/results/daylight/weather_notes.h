#pragma once
// Summary of a weather file, for messages.

#include <string>
#include <vector>

#include "results/daylight/daylight_year.h"

namespace lumel {

/// Place, hours, and where their illuminance is from.
std::string weather_summary(const Weather& weather, const DaylightYear& year,
                            const OccupiedHours& occupied);

/// Sentences about hours without values and with values that cannot be; empty if there are none.
std::vector<std::string> weather_faults(const Weather& weather);

}  // namespace lumel
