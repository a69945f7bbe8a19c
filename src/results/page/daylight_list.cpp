#include "results/page/daylight_list.h"

#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "results/page/lamp_list.h"

namespace lumel {
namespace {

constexpr double kMaxLux = 1e9;
/// Deviation of a direction's length from 1: directions may be rounded.
constexpr double kLengthError = 0.01;

constexpr std::array<int, 12> kDaysOfMonths = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
constexpr int kHoursOfDay = 24;
constexpr std::string_view kHourPattern = "00-00T00";  // month, day, hour

/// The number of two digits, or -1.
int two_digits(std::string_view text)
{
    const auto digit = [](char letter) { return letter >= '0' && letter <= '9'; };
    return digit(text[0]) && digit(text[1]) ? 10 * (text[0] - '0') + text[1] - '0' : -1;
}

/// Index of an hour as in ListedHour.
int hour_of(const JsonView& view)
{
    const std::string& text = view.string();
    if (text.size() == kHourPattern.size() && text[2] == '-' && text[5] == 'T') {
        const std::string_view all(text);
        const int month = two_digits(all.substr(0, 2)), day = two_digits(all.substr(3, 2)),
                  hour = two_digits(all.substr(6, 2));
        if (month >= 1 && month <= int(kDaysOfMonths.size()) && day >= 1 &&
            day <= kDaysOfMonths[std::size_t(month - 1)] && hour >= 0 && hour < kHoursOfDay) {
            int days = day - 1;
            for (int before = 0; before < month - 1; ++before)
                days += kDaysOfMonths[std::size_t(before)];
            return kHoursOfDay * days + hour;
        }
    }
    view.fail("is " + lumel::quoted(text) + ", but must be an hour of the year, such as 06-21T15");
}

glm::dvec3 direction_of(const JsonView& view)
{
    if (view.as_array().json().size() != 3)
        view.fail("must be [x, y, z]");
    glm::dvec3 direction(0.0);
    for (int axis = 0; axis < 3; ++axis)
        direction[axis] =
            view.at(std::size_t(axis)).number(-1.0 - kLengthError, 1.0 + kLengthError);
    if (std::abs(glm::length(direction) - 1.0) > kLengthError)
        view.fail("must be of length 1");
    return direction;
}

std::vector<float> weights_of(const JsonView& view, std::size_t maps)
{
    std::vector<float> weights;
    view.each([&](const JsonView& weight, std::size_t) { weights.push_back(weight.number()); });
    if (weights.size() != maps)
        view.fail("has " + std::to_string(weights.size()) +
                  " weights, but must have one for each of " + std::to_string(maps) + " maps");
    return weights;
}

std::vector<std::string> maps_of(const JsonView& list, int pages)
{
    std::vector<std::string> maps;
    list.each([&](const JsonView& view, std::size_t) {
        hour_of(view.get("hour"));
        maps.push_back(map_path_of(view.get("map"), pages));
    });
    if (maps.empty() || maps.size() > kMaxDaylightMaps)
        list.fail("has " + std::to_string(maps.size()) + " maps, but must have 1 to " +
                  std::to_string(kMaxDaylightMaps));
    return maps;
}

std::vector<ListedHour> hours_of(const JsonView& list, std::size_t maps)
{
    std::vector<ListedHour> hours;
    list.each([&](const JsonView& view, std::size_t) {
        hours.push_back({.index = hour_of(view.get("hour")),
                         .sun = direction_of(view.get("sun")),
                         .lux = view.get("lux").number(0.0, kMaxLux),
                         .mean = view.get("mean").number(0.0, kMaxLux),
                         .weights = weights_of(view.get("weights"), maps)});
        if (hours.size() > 1 && hours.back().index <= hours[hours.size() - 2].index)
            view.get("hour").fail("must be later than the hour before it");
    });
    if (hours.empty())
        list.fail("has no hour, but must have those with light");
    return hours;
}

}  // namespace

ListedDaylight daylight_of(const JsonView& document, int pages)
{
    const JsonView place = document.get("place");
    ListedDaylight daylight{
        .place = place.get("name").string(),
        .latitude = place.get("latitude").number(-90.0, 90.0),
        .longitude = place.get("longitude").number(-180.0, 180.0),
        .error = document.get("error").number(0.0, std::numeric_limits<double>::max()),
        .maps = maps_of(document.get("maps"), pages),
        .hours = {}};
    daylight.hours = hours_of(document.get("hours"), daylight.maps.size());
    return daylight;
}

}  // namespace lumel
