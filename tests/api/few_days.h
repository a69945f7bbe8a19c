#pragma once
// A weather file of a few days.

#include <fstream>
#include <string>

#include "../support/temporary_folder.h"
#include "../support/weather_text.h"

namespace lumel::v0::test {

inline constexpr std::size_t kHoursOfDay = 24;

/// The name of a new weather file.
template <class Of>
std::string weather_file(const lumel::test::TemporaryFolder& folder, const Of& of)
{
    std::string path = folder / "made.epw";
    std::ofstream(path) << support::weather_text(of);
    return path;
}

/// Light from 10 to 14 o'clock on each 30th day, with sun on every other of these.
inline support::WeatherOfHour few_days(int hour)
{
    const int day = hour / int(kHoursOfDay), of_day = hour % int(kHoursOfDay);
    if (day % 30 != 15 || of_day < 10 || of_day >= 14)
        return {};
    return {.direct = day % 60 == 15 ? 500.0 : 0.0, .diffuse = 100.0 + 10.0 * of_day};
}

}  // namespace lumel::v0::test
