// EPW [EPW]: eight header lines that begin with their names, then a line of at least 35 columns for
// each hour. Columns, from 0:
//
//     0 year, 1 month, 2 day, 3 hour that ends, 1 to 24, of local standard time
//     7 dew point [°C], 99.9: missing
//     14 direct normal, 15 diffuse horizontal radiation [Wh/m²], 9999 and above: missing
//     17 direct normal, 18 diffuse horizontal illuminance [lx], 999900 and above: missing
//
// Line LOCATION: 1 city, 6 latitude and 7 longitude [degrees north and east], 8 hours before UTC.
// Line DATA PERIODS: 2 records per hour.

#include "scene/sky/weather_file.h"

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

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
/// Columns that are read.
constexpr std::size_t kColumns = kDiffuseLux + 1;
constexpr std::size_t kCity = 1, kLatitude = 6, kLongitude = 7, kTimeZone = 8, kPerHour = 2;
constexpr double kNoRadiation = 9999.0, kNoIlluminance = 999900.0, kNoDewPoint = 99.9;
/// Dew point for 2 cm of precipitable water by [PISMS90], where the file has none [°C].
constexpr double kUsualDewPoint = 11.0;
constexpr double kSecondsPerHour = 3600.0;
constexpr int kFirstYear = 1900, kLastYear = 2100;

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
            constexpr double kQuarter = 90.0, kHalf = 180.0, kMostHours = 14.0;
            constexpr double kDegree = std::numbers::pi / kHalf;
            weather.city = lines.column(kCity);
            weather.latitude = kDegree * lines.number(kLatitude, "latitude", -kQuarter, kQuarter);
            weather.longitude = kDegree * lines.number(kLongitude, "longitude", -kHalf, kHalf);
            time_zone = lines.number(kTimeZone, "time zone", -kMostHours, kMostHours);
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

/// Midnight at which a day begins, of UTC [s], and the day's number in its year.
std::pair<double, int> day_of(const Lines& lines)
{
    namespace chrono = std::chrono;
    constexpr int kMonths = 12, kDays = 31;
    const chrono::year year(lines.whole(kYear, "year", kFirstYear, kLastYear));
    const chrono::month month(unsigned(lines.whole(kMonth, "month", 1, kMonths)));
    // A year put together of several can have 29 February where its own has none.
    const chrono::sys_days first(chrono::year_month_day(year, month, chrono::day(1)));
    const chrono::sys_days day = first + chrono::days(lines.whole(kDay, "day", 1, kDays) - 1);
    constexpr chrono::year_month_day kEpoch{chrono::year(2000), chrono::January, chrono::day(1)};
    constexpr double kNoon = 12.0, kHoursOfDay = 24.0;
    const auto days = double((day - chrono::sys_days(kEpoch)).count());
    const chrono::sys_days new_year(chrono::year_month_day(year, chrono::January, chrono::day(1)));
    return {(kHoursOfDay * days - kNoon) * kSecondsPerHour, int((day - new_year).count()) + 1};
}

/// Adds the hour of a line. Returns true if it has no illuminance although there is radiation.
bool add_hour(const Lines& lines, double time_zone, Weather& weather)
{
    constexpr int kLastHour = 24;
    const auto [midnight, day_of_year] = day_of(lines);
    WeatherHour hour{.month = int(lines.number(kMonth, "month")),
                     .day = int(lines.number(kDay, "day")),
                     .day_of_year = day_of_year,
                     .ends = lines.whole(kHour, "hour", 1, kLastHour)};
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
        hour.direct_lux = direct_lux.value_or(0.0);
        hour.diffuse_lux = diffuse_lux.value_or(0.0);
    }
    weather.hours.push_back(hour);
    return (hour.direct > 0.0 && !direct_lux) || (hour.diffuse > 0.0 && !diffuse_lux);
}

}  // namespace

Weather read_weather(const Bytes& bytes, const std::string& place)
{
    Lines lines({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, place);
    Weather weather;
    const double time_zone = read_header(lines, weather);
    bool lacks_illuminance = false;
    double diffuse_lux = 0.0;
    while (lines.next()) {
        if (lines.columns() < kColumns)
            lines.fail("has " + std::to_string(lines.columns()) + " columns, but an hour has " +
                       std::to_string(kColumns) + " and more: the file is cut short");
        if (weather.hours.size() == kHoursOfLeapYear)
            lines.fail("the file has more hours than a year");
        lacks_illuminance |= add_hour(lines, time_zone, weather);
        diffuse_lux += weather.hours.back().diffuse_lux;
    }
    const std::size_t count = weather.hours.size();
    if (count != kHoursOfYear && count != kHoursOfLeapYear)
        lines.fail("the file ends after " + std::to_string(count) + " hours of " +
                   std::to_string(kHoursOfYear) + ": it is cut short");
    // Files without illuminance have zeros or the mark of missing values.
    weather.has_illuminance = !lacks_illuminance && diffuse_lux > 0.0;
    return weather;
}

}  // namespace lumel
