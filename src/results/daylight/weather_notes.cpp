#include "results/daylight/weather_notes.h"

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

namespace lumel {

std::string weather_summary(const Weather& weather, const DaylightYear& year,
                            const OccupiedHours& occupied)
{
    std::size_t by_file = 0, by_efficacy = 0;
    for (std::size_t h = 0; h < year.hours(); ++h)
        if (const WeatherHour& hour = weather.hours[year.number(h)]; has_light(hour))
            ++(hour.has_illuminance ? by_file : by_efficacy);
    return fmt::format(
        "weather of {} ({:.2f}° N, {:.2f}° E): {} hours from {} to {} o'clock; {} with the "
        "illuminance of the file, {} with luminous efficacy by Perez et al. 1990, {} dark",
        weather.city, glm::degrees(weather.latitude), glm::degrees(weather.longitude), year.hours(),
        occupied.from, occupied.to, by_file, by_efficacy, year.hours() - by_file - by_efficacy);
}

std::vector<std::string> weather_faults(const Weather& weather)
{
    std::vector<std::string> notes;
    if (weather.missing > 0)
        notes.push_back(
            fmt::format("{} hours of the weather file have no radiation values and count as dark",
                        weather.missing));
    if (weather.at_night > 0)
        notes.push_back(fmt::format(
            "{} hours of the weather file have direct radiation while the sun is more than 5° "
            "below the horizon: check its place and its time zone",
            weather.at_night));
    return notes;
}

}  // namespace lumel
