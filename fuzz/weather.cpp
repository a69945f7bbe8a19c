#include <cmath>
#include <numbers>

#include "readers.h"
#include "scene/sky/weather_file.h"

namespace lumel::fuzz {

void read_weather(Input input)
{
    const Weather weather = lumel::read_weather({input.begin(), input.end()}, "year.epw");
    require(weather.hours.size() == 8760 || weather.hours.size() == 8784, "a year has its hours");
    require(std::abs(weather.latitude) <= 0.5 * std::numbers::pi, "latitudes end at the poles");
    for (const WeatherHour& hour : weather.hours) {
        require(hour.ends >= 1 && hour.ends <= 24, "hours are of a day");
        require(hour.direct >= 0.0 && hour.diffuse >= 0.0, "radiation is not below 0");
        require(hour.direct_lux >= 0.0 && hour.diffuse_lux >= 0.0, "light is not below 0");
    }
}

}  // namespace lumel::fuzz
