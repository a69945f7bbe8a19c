// The sky of an hour is that of [PSM93], as the mean over each patch, with its illuminance on a
// horizontal plane exact. The sun is that of the middle of the hour.
//
// Over a year the sun stays between two circles of declination. For what surfaces reflect of it,
// its position is interpolated, linearly in declination and hour angle, between those of a grid.
// With up U, north N, east E and latitude φ:
//
//     pole P = cos φ N + sin φ U      meridian M = −sin φ N + cos φ U
//     sin δ = s·P,  cos δ cos H = s·M,  cos δ sin H = −s·E

#include "results/daylight/daylight_year.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <glm/trigonometric.hpp>

#include "scene/sky/perez_sky.h"
#include "scene/sky/sun.h"

namespace lumel {
namespace {

/// Parts of an angle of a patch for light that is not reflected: patches of 6°.
constexpr std::size_t kDivision = 2;
/// Steps of the grid: half an hour, and a sixth of the range of declination.
constexpr double kHourStep = glm::radians(7.5);
constexpr double kObliquity = glm::radians(23.44);
constexpr double kDeclinationStep = kObliquity / 3.0;

/// Directions about a place of a latitude.
struct Celestial {
    glm::dvec3 pole, meridian;

    explicit Celestial(double latitude)
        : pole(0.0, std::sin(latitude), -std::cos(latitude)),
          meridian(0.0, std::cos(latitude), std::sin(latitude))
    {
    }

    /// Declination and hour angle.
    glm::dvec2 angles_of(const glm::dvec3& direction) const
    {
        return {std::asin(std::clamp(glm::dot(direction, pole), -1.0, 1.0)),
                std::atan2(-direction.x, glm::dot(direction, meridian))};
    }

    /// Direction to a place; to the horizon below one that has set.
    glm::vec3 direction_of(double declination, double hour_angle) const
    {
        glm::dvec3 direction =
            std::sin(declination) * pole +
            std::cos(declination) * (std::cos(hour_angle) * meridian -
                                     std::sin(hour_angle) * glm::dvec3(1.0, 0.0, 0.0));
        direction.y = std::max(direction.y, 0.0);
        return glm::vec3(glm::normalize(direction));
    }
};

}  // namespace

DaylightYear::DaylightYear(const Weather& weather, const OccupiedHours& occupied)
    : patches_(kDivision)
{
    const SkyPatches whole;
    for (std::size_t patch = 0; patch < patches_.count(); ++patch)
        shares_.push_back(
            float(patches_.solid_angle(patch) / whole.solid_angle(patches_.whole(patch))));
    for (std::size_t i = 0; i < weather.hours.size(); ++i)
        if (weather.hours[i].ends > occupied.from && weather.hours[i].ends <= occupied.to)
            numbers_.push_back(i);
    suns_.resize(numbers_.size());
    luminance_.assign(patches_.count() * numbers_.size(), 0.0f);
    for (std::size_t hour = 0; hour < numbers_.size(); ++hour)
        add_sky(weather.hours[numbers_[hour]], weather, hour);
    place_suns(weather.latitude);
}

/// Adds the sky of an hour, and the light of its sun.
void DaylightYear::add_sky(const WeatherHour& hour, const Weather& weather, std::size_t index)
{
    if (!has_light(hour))
        return;
    const SunPosition sun = sun_position(weather.latitude, weather.longitude, hour.middle);
    const PerezSky sky({hour.direct, hour.diffuse, hour.day_of_year, hour.dew_point}, sun);
    SunPosition raised = sun;
    raised.elevation = std::max(sun.elevation, 0.0);
    const glm::dvec3 to_sun(direction_of(raised));
    const std::vector<double> means = patches_.means([&](const glm::dvec3& direction) {
        return sky.luminance(direction.y,
                             std::acos(std::clamp(glm::dot(direction, to_sun), -1.0, 1.0)));
    });
    double on_plane = 0.0;
    for (std::size_t patch = 0; patch < means.size(); ++patch)
        on_plane += means[patch] * patches_.projected(patch);
    const double lux =
        hour.has_illuminance ? hour.diffuse_lux : hour.diffuse * sky.diffuse_efficacy();
    for (std::size_t patch = 0; on_plane > 0.0 && patch < means.size(); ++patch)
        luminance_[patch * hours() + index] = float(means[patch] * lux / on_plane);
    suns_[index].direction = glm::vec3(to_sun);
    if (sun.elevation > 0.0)
        suns_[index].lux =
            float(hour.has_illuminance ? hour.direct_lux : hour.direct * sky.direct_efficacy());
}

double DaylightYear::open_ground(std::size_t hour) const
{
    double lux = double(suns_[hour].lux * suns_[hour].direction.y);
    for (std::size_t patch = 0; patch < patches_.count(); ++patch)
        lux += patches_.projected(patch) * double(luminance(patch)[hour]);
    return lux;
}

std::vector<float> DaylightYear::strengths(std::size_t hour, Sun::Grid grid) const
{
    const std::size_t whole = SkyPatches().count();
    std::vector<float> strengths(whole + places_.size(), 0.0f);
    for (std::size_t patch = 0; patch < patches_.count(); ++patch)
        strengths[patches_.whole(patch)] += shares_[patch] * luminance(patch)[hour];
    for (const Sun::Share& share : suns_[hour].*grid)
        if (suns_[hour].lux > 0.0f)
            strengths[whole + share.place] += share.weight * suns_[hour].lux;
    return strengths;
}

void DaylightYear::place_suns(double latitude)
{
    const Celestial celestial(latitude);
    std::map<std::pair<int, int>, std::uint32_t> numbers;
    const auto number_of = [&](int declination, int hour_angle) {
        const auto [at, is_new] =
            numbers.emplace(std::pair(declination, hour_angle), std::uint32_t(places_.size()));
        if (is_new)
            places_.push_back(
                celestial.direction_of(declination * kDeclinationStep, hour_angle * kHourStep));
        return at->second;
    };
    const auto shares_of = [&](const glm::dvec2& at, int step) {
        const glm::dvec2 low = glm::floor(at / double(step)), part = at / double(step) - low;
        std::array<Sun::Share, 4> shares;
        for (int k = 0; k < 4; ++k) {
            const int i = k / 2, j = k % 2;
            shares[std::size_t(k)] = {
                number_of(step * (int(low.x) + i), step * (int(low.y) + j)),
                float((i ? part.x : 1.0 - part.x) * (j ? part.y : 1.0 - part.y))};
        }
        return shares;
    };
    for (Sun& sun : suns_) {
        if (!(sun.lux > 0.0f))
            continue;
        const glm::dvec2 at = celestial.angles_of(glm::dvec3(sun.direction)) /
                              glm::dvec2(kDeclinationStep, kHourStep);
        sun.near = shares_of(at, 1);
        sun.wide = shares_of(at, 2);
    }
}

}  // namespace lumel
