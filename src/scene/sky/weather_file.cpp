// EPW [EPW]: eight header lines that begin with their names, then a line of 35 columns or more for
// each hour. Columns, from 0:
//
//     0 year, 1 month, 2 day, 3 hour that ends, 1 to 24, of local standard time
//     7 dew point [°C], 99.9: missing
//     14 direct normal, 15 diffuse horizontal radiation [Wh/m²], 9999 and above: missing
//     17 direct normal, 18 diffuse horizontal illuminance [lx], 999900 and above: missing;
//        files without illuminance also have 0
//
// Line LOCATION: 1 city, 6 latitude and 7 longitude [degrees north and east], 8 hours before UTC.
// Line DATA PERIODS: 2 records per hour.

#include "scene/sky/weather_file.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <optional>
#include <string_view>

#include <glm/trigonometric.hpp>

#include "base/core/error.h"
#include "base/core/number.h"
#include "base/json/json_view.h"
#include "scene/sky/sun.h"

namespace lumel {
namespace {

constexpr std::size_t kHoursOfYear = 8760, kHoursOfLeapYear = 8784;
constexpr std::size_t kHeaderLines = 8;
constexpr std::size_t kYear = 0, kMonth = 1, kDay = 2, kHour = 3, kDewPoint = 7, kDirect = 14,
                      kDiffuse = 15, kDirectLux = 17, kDiffuseLux = 18;
/// Columns of an hour.
constexpr std::size_t kColumns = 35;
constexpr std::size_t kCity = 1, kLatitude = 6, kLongitude = 7, kTimeZone = 8, kPerHour = 2;
constexpr double kNoRadiation = 9999.0, kNoIlluminance = 999900.0, kNoDewPoint = 99.9;
/// Dew point for 2 cm of precipitable water by [PISMS90], where the file has none [°C].
constexpr double kUsualDewPoint = 11.0;
constexpr double kSecondsPerHour = 3600.0;
constexpr int kFirstYear = 1900, kLastYear = 2100;
constexpr int kDayHours = 24;
/// Radiation above which an illuminance of 0 is a missing one [W/m²].
constexpr double kSurelyBright = 20.0;
/// Most that local standard time differs from the sun's: in the west of China almost 3 [h].
constexpr double kMostHoursFromSun = 3.0;
/// Elevation below which the sun has no direct radiation, even if it rises later in the hour [rad].
constexpr double kNight = glm::radians(-5.0);

/// The lines of a file, split at commas.
class Lines {
public:
    Lines(std::string_view text, const std::string& place) : text_(text), place_(place) {}

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error(ErrorKind::input, place_ + ": line " + std::to_string(line_), what);
    }

    /// The next line that is not empty; false at the end.
    bool next()
    {
        while (at_ < text_.size()) {
            const std::size_t end = std::min(text_.find('\n', at_), text_.size());
            std::string_view line = text_.substr(at_, end - at_);
            at_ = end + 1;
            ++line_;
            while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
                line.remove_suffix(1);
            if (line.empty())
                continue;
            split(line);
            return true;
        }
        return false;
    }

    std::size_t columns() const { return columns_.size(); }
    std::string_view column(std::size_t index) const { return columns_[index]; }

    double number(std::size_t index, const char* what) const
    {
        const std::optional<double> value = number_of(columns_[index]);
        if (!value)
            fail(quoted(std::string(columns_[index])) + " in column " + std::to_string(index + 1) +
                 " is not a number, but the " + what + " must be");
        return *value;
    }

    double number(std::size_t index, const char* what, double low, double high) const
    {
        const double value = number(index, what);
        if (!(value >= low && value <= high))
            fail(std::string("the ") + what + " " + std::string(columns_[index]) +
                 " is not between " + std::to_string(int(low)) + " and " +
                 std::to_string(int(high)));
        return value;
    }

    int whole(std::size_t index, const char* what, int low, int high) const
    {
        const double value = number(index, what, low, high);
        if (value != std::floor(value))
            fail(std::string("the ") + what + " must be a whole number");
        return int(value);
    }

private:
    void split(std::string_view line)
    {
        columns_.clear();
        for (;;) {
            const std::size_t comma = std::min(line.find(','), line.size());
            std::string_view column = line.substr(0, comma);
            while (column.starts_with(' '))
                column.remove_prefix(1);
            while (column.ends_with(' '))
                column.remove_suffix(1);
            columns_.push_back(column);
            if (comma == line.size())
                return;
            line.remove_prefix(comma + 1);
        }
    }

    std::string_view text_;
    const std::string& place_;
    std::size_t at_ = 0;
    int line_ = 0;
    std::vector<std::string_view> columns_;
};

/// longitude: [°]. time_zone: [h].
void check_time_zone(const Lines& lines, double longitude, double time_zone)
{
    constexpr double kDegreesPerHour = 15.0;
    const double apart =
        std::abs(std::remainder(longitude / kDegreesPerHour - time_zone, double(kDayHours)));
    if (apart > kMostHoursFromSun)
        lines.fail("the longitude " + std::string(lines.column(kLongitude)) +
                   " is not in the time zone " + std::string(lines.column(kTimeZone)) +
                   ": its noon is more than 3 hours off");
}

/// Reads the header. Returns the time zone [h].
double read_header(Lines& lines, Weather& weather)
{
    double time_zone = 0.0;
    for (std::size_t line = 0; line < kHeaderLines; ++line) {
        if (!lines.next())
            lines.fail("the file ends in its header");
        if (line == 0) {
            if (lines.column(0) != "LOCATION" || lines.columns() <= kTimeZone)
                lines.fail("is not a weather file: an EPW file begins with LOCATION, the city and "
                           "its latitude, longitude and time zone");
            weather.city = lines.column(kCity);
            const double longitude = lines.number(kLongitude, "longitude", -180.0, 180.0);  // [°]
            weather.latitude = glm::radians(lines.number(kLatitude, "latitude", -90.0, 90.0));
            weather.longitude = glm::radians(longitude);
            time_zone = lines.number(kTimeZone, "time zone", -14.0, 14.0);  // [h]
            check_time_zone(lines, longitude, time_zone);
        }
        if (lines.column(0) == "DATA PERIODS" && lines.columns() > kPerHour &&
            lines.number(kPerHour, "number of records per hour") != 1.0)
            lines.fail("the file has more than one record per hour; one is read");
    }
    return time_zone;
}

/// A value of light: nothing if it is missing.
std::optional<double> light_in(const Lines& lines, std::size_t column, const char* what,
                               double missing)
{
    const double value = lines.number(column, what);
    if (value < 0.0)
        lines.fail(std::string("the ") + what + " is below 0");
    return value < missing ? std::optional(value) : std::nullopt;
}

/// Month, day and hour at which a line ends.
struct HourInYear {
    int month, day, hour;

    bool operator==(const HourInYear&) const = default;
};

int days_of(int month)
{
    constexpr std::array<int, 12> kDays = {31, 29, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    return kDays[std::size_t(month - 1)];
}

HourInYear hour_in_year(const Lines& lines)
{
    constexpr int kMonths = 12;
    const int month = lines.whole(kMonth, "month", 1, kMonths);
    return {month, lines.whole(kDay, "day", 1, days_of(month)),
            lines.whole(kHour, "hour", 1, kDayHours)};
}

/// True if `next` is the hour after `last`, whatever the year.
bool follows(const HourInYear& next, const HourInYear& last)
{
    constexpr int kFebruary = 2, kMonths = 12;
    if (last.hour < kDayHours)
        return next == HourInYear{last.month, last.day, last.hour + 1};
    const HourInYear new_month{last.month % kMonths + 1, 1, 1};
    const int left = days_of(last.month) - last.day;
    return (left > 0 && next == HourInYear{last.month, last.day + 1, 1}) ||
           ((left == 0 || (left == 1 && last.month == kFebruary)) && next == new_month);
}

/// Refuses an hour that does not follow the one before.
void check_order(const Lines& lines, const Weather& weather)
{
    const HourInYear is = hour_in_year(lines);
    if (weather.hours.empty() && is.hour != 1)
        lines.fail("the first hour of the file is not the first of a day");
    if (weather.hours.empty())
        return;
    const WeatherHour& last = weather.hours.back();
    if (!follows(is, {last.month, last.day, last.ends}))
        lines.fail("the hour does not follow that of the line before");
}

/// Midnight at which a day begins, of UTC [s], and the day's number in its year.
std::pair<double, int> day_of(const Lines& lines, const HourInYear& is)
{
    namespace chrono = std::chrono;
    const chrono::year year(lines.whole(kYear, "year", kFirstYear, kLastYear));
    // A year put together of several can have 29 February where its own has none.
    const chrono::sys_days first(
        chrono::year_month_day(year, chrono::month(unsigned(is.month)), chrono::day(1)));
    const chrono::sys_days day = first + chrono::days(is.day - 1);
    constexpr chrono::year_month_day kEpoch{chrono::year(2000), chrono::January, chrono::day(1)};
    constexpr double kNoon = 12.0;
    const auto days = double((day - chrono::sys_days(kEpoch)).count());
    const chrono::sys_days new_year(chrono::year_month_day(year, chrono::January, chrono::day(1)));
    return {(kDayHours * days - kNoon) * kSecondsPerHour, int((day - new_year).count()) + 1};
}

/// True if there is radiation [W/m²] but no illuminance of it.
bool is_missing(double radiation, std::optional<double> lux)
{
    return radiation > 0.0 && (!lux || (*lux == 0.0 && radiation > kSurelyBright));
}

/// Adds the hour of a line.
void add_hour(const Lines& lines, double time_zone, Weather& weather)
{
    const HourInYear is = hour_in_year(lines);
    const auto [midnight, day_of_year] = day_of(lines, is);
    WeatherHour hour{.month = is.month, .day = is.day, .day_of_year = day_of_year, .ends = is.hour};
    hour.middle = midnight + (hour.ends - 0.5 - time_zone) * kSecondsPerHour;
    const double dew_point = lines.number(kDewPoint, "dew point");
    hour.dew_point = dew_point < kNoDewPoint ? dew_point : kUsualDewPoint;
    const auto direct = light_in(lines, kDirect, "direct normal radiation", kNoRadiation);
    const auto diffuse = light_in(lines, kDiffuse, "diffuse horizontal radiation", kNoRadiation);
    const auto direct_lux =
        light_in(lines, kDirectLux, "direct normal illuminance", kNoIlluminance);
    const auto diffuse_lux =
        light_in(lines, kDiffuseLux, "diffuse horizontal illuminance", kNoIlluminance);
    weather.missing += direct && diffuse ? 0 : 1;
    if (direct && diffuse) {
        hour.direct = *direct;
        hour.diffuse = *diffuse;
        hour.has_illuminance =
            !is_missing(*direct, direct_lux) && !is_missing(*diffuse, diffuse_lux);
    }
    if (hour.has_illuminance) {
        hour.direct_lux = direct_lux.value_or(0.0);
        hour.diffuse_lux = diffuse_lux.value_or(0.0);
    }
    if (hour.direct > 0.0 &&
        sun_position(weather.latitude, weather.longitude, hour.middle).elevation < kNight)
        ++weather.at_night;
    weather.hours.push_back(hour);
}

}  // namespace

Weather read_weather(const Bytes& bytes, const std::string& place)
{
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    if (text.starts_with(kByteOrderMark))
        text.remove_prefix(kByteOrderMark.size());
    Lines lines(text, place);
    Weather weather;
    const double time_zone = read_header(lines, weather);
    while (lines.next()) {
        if (lines.columns() < kColumns)
            lines.fail("has " + std::to_string(lines.columns()) + " columns, but an hour has " +
                       std::to_string(kColumns) + ": the file is cut short");
        if (weather.hours.size() == kHoursOfLeapYear)
            lines.fail("the file has more hours than a year");
        check_order(lines, weather);
        add_hour(lines, time_zone, weather);
    }
    const std::size_t count = weather.hours.size();
    if (count != kHoursOfYear && count != kHoursOfLeapYear)
        lines.fail("the file ends after " + std::to_string(count) + " hours of " +
                   std::to_string(kHoursOfYear) + ": it is cut short");
    if (std::ranges::none_of(weather.hours, has_light))
        lines.fail("no hour of the file has radiation of sun or sky");
    return weather;
}

}  // namespace lumel
