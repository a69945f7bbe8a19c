#pragma once
// Weather files: a year of hours at one place, as EnergyPlus reads them (.epw).

#include <cstdint>
#include <string>
#include <vector>

#include "base/core/files.h"

namespace lumel {

/// An hour of local standard time.
struct WeatherHour {
    double middle = 0.0;  ///< in the format of seconds_since_2000()
    int month = 1, day = 1, day_of_year = 1;
    int ends = 1;                  ///< hour of the day at which it ends, 1 to 24
    double direct = 0.0;           ///< radiation of the sun on a plane that faces it [W/m²]
    double diffuse = 0.0;          ///< radiation of the sky on a horizontal plane [W/m²]
    bool has_illuminance = false;  ///< the file has the illuminance of this radiation:
    double direct_lux = 0.0;       ///< [lx]
    double diffuse_lux = 0.0;      ///< [lx]
    double dew_point = 0.0;        ///< [°C]
};

inline bool has_light(const WeatherHour& hour)
{
    return hour.direct > 0.0 || hour.diffuse > 0.0;
}

struct Weather {
    std::string city;
    double latitude = 0.0, longitude = 0.0;  ///< [rad] north and east
    std::size_t missing = 0;                 ///< hours without radiation values, which are dark
    std::size_t at_night = 0;        ///< hours with direct radiation, the sun far below the horizon
    std::vector<WeatherHour> hours;  ///< of 365 or 366 days
};

/// Reads an EPW file of one year in hours. `place` names it in messages. Throws Error{input} with
/// the faulty line.
Weather read_weather(const Bytes& bytes, const std::string& place);

}  // namespace lumel
