#pragma once
// Summary of a weather file, for messages.

#include <string>
#include <vector>

#include "results/daylight/daylight_year.h"

namespace lumel {

std::vector<std::string> weather_notes(const Weather& weather, const DaylightYear& year,
                                       const OccupiedHours& occupied);

}  // namespace lumel
