// Position of the sun by the low-precision formulas of the Astronomical Almanac [AA]. With n days
// since noon of 1 January 2000:
//
//     L = 280.460° + 0.9856474° n          mean longitude
//     g = 357.528° + 0.9856003° n          mean anomaly
//     λ = L + 1.915° sin g + 0.020° sin 2g ecliptic longitude
//     ε = 23.439° − 0.0000004° n           obliquity of the ecliptic
//     tan α = cos ε tan λ,  sin δ = sin ε sin λ
//     θ = 280.46062° + 360.98564737° n     sidereal angle of Greenwich
//
// and for the observer at latitude φ, with the hour angle H = θ + longitude − α:
//
//     sin elevation = sin φ sin δ + cos φ cos δ cos H
//     tan azimuth   = −cos δ sin H / (cos φ sin δ − sin φ cos δ cos H)

#include "scene/sky/sun.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

#include <glm/gtc/constants.hpp>

#include "base/core/error.h"
#include "base/json/json_view.h"

namespace lumel {
namespace {

constexpr double kSecondsPerDay = 86400.0;

[[noreturn]] void refuse_time(const std::string& date_time)
{
    throw Error(ErrorKind::input, "",
                quoted(date_time) + " is not a date and time such as 2024-06-21T12:00:00Z (UTC) or "
                                    "2024-06-21T14:00:00+02:00");
}

/// Local time minus UTC [s]: "+02:00", "+0200" or "+02", or "Z" or nothing for UTC.
std::optional<int> offset_of(std::string text)
{
    constexpr std::size_t kHours = 3, kWithMinutes = 5;  // characters, including the sign
    constexpr int kMaxHours = 14;                        // maximum on earth
    if (text.empty() || text == "Z")
        return 0;
    if (text.size() == kWithMinutes + 1 && text[kHours] == ':')
        text.erase(kHours, 1);
    const bool digits = std::all_of(text.begin() + 1, text.end(),
                                    [](char letter) { return letter >= '0' && letter <= '9'; });
    if ((text[0] != '+' && text[0] != '-') || !digits ||
        (text.size() != kHours && text.size() != kWithMinutes))
        return {};
    const int hours = std::stoi(text.substr(1, 2));
    const int minutes = text.size() == kWithMinutes ? std::stoi(text.substr(kHours)) : 0;
    if (hours > kMaxHours || minutes > 59)
        return {};
    return (text[0] == '-' ? -1 : 1) * (hours * 3600 + minutes * 60);
}

}  // namespace

double seconds_since_2000(const std::string& date_time)
{
    namespace chrono = std::chrono;
    int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0, length = 0;
    const int read = std::sscanf(date_time.c_str(), "%4d-%2d-%2dT%2d:%2d%n:%2d%n", &year, &month,
                                 &day, &hour, &minute, &length, &second, &length);
    if (read < 5)
        refuse_time(date_time);
    const std::optional<int> offset = offset_of(date_time.substr(std::size_t(length)));
    const chrono::year_month_day date{chrono::year(year), chrono::month(unsigned(month)),
                                      chrono::day(unsigned(day))};
    const bool valid = date.ok() && hour >= 0 && hour < 24 && minute >= 0 && minute < 60 &&
                       second >= 0 && second <= 60;
    if (!valid || !offset)
        refuse_time(date_time);
    constexpr chrono::year_month_day kEpoch{chrono::year(2000), chrono::January, chrono::day(1)};
    const auto days = (chrono::sys_days(date) - chrono::sys_days(kEpoch)).count();
    return (double(days) - 0.5) * kSecondsPerDay + hour * 3600.0 + minute * 60.0 + second - *offset;
}

SunPosition sun_position(double latitude, double longitude, double seconds_since_2000)
{
    const double n = seconds_since_2000 / kSecondsPerDay;
    const double mean_longitude = glm::radians(280.460 + 0.9856474 * n);
    const double g = glm::radians(357.528 + 0.9856003 * n);
    const double ecliptic =
        mean_longitude + glm::radians(1.915 * std::sin(g) + 0.020 * std::sin(2.0 * g));
    const double obliquity = glm::radians(23.439 - 0.0000004 * n);
    const double ascension =
        std::atan2(std::cos(obliquity) * std::sin(ecliptic), std::cos(ecliptic));
    const double declination = std::asin(std::sin(obliquity) * std::sin(ecliptic));
    const double sidereal = glm::radians(std::fmod(280.46062 + 360.98564737 * n, 360.0));

    const double hour = sidereal + longitude - ascension;
    const double up = std::sin(latitude) * std::sin(declination) +
                      std::cos(latitude) * std::cos(declination) * std::cos(hour);
    const double east = -std::cos(declination) * std::sin(hour);
    const double north = std::cos(latitude) * std::sin(declination) -
                         std::sin(latitude) * std::cos(declination) * std::cos(hour);
    const double azimuth = std::atan2(east, north);
    return {azimuth < 0.0 ? azimuth + glm::two_pi<double>() : azimuth,
            std::asin(std::clamp(up, -1.0, 1.0))};
}

glm::vec3 direction_of(const SunPosition& sun)
{
    return {std::sin(sun.azimuth) * std::cos(sun.elevation), std::sin(sun.elevation),
            -std::cos(sun.azimuth) * std::cos(sun.elevation)};
}

}  // namespace lumel
