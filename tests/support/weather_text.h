#pragma once
// Weather files made by a test.

#include <string>

namespace lumel::support {

/// What an hour of such a file has.
struct WeatherOfHour {
    double direct = 0.0, diffuse = 0.0;          ///< radiation [W/m²]
    double direct_lux = 0.0, diffuse_lux = 0.0;  ///< [lx]
};

/// An EPW file of 2001. of(hour of the year from 0): a WeatherOfHour. zone: hours before UTC.
/// february: its days.
template <class Of>
std::string weather_text(const Of& of, double latitude = 47.5, double longitude = 19.0,
                         double zone = 1.0, int february = 28)
{
    const int days[] = {31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
    std::string text = "LOCATION,Test,-,-,made,0," + std::to_string(latitude) + "," +
                       std::to_string(longitude) + "," + std::to_string(zone) +
                       ",100\nDESIGN CONDITIONS,0\nTYPICAL/EXTREME PERIODS,0\n"
                       "GROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"
                       "COMMENTS 1,made\nCOMMENTS 2,made\n"
                       "DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31\n";
    int number = 0;
    for (int month = 1; month <= 12; ++month)
        for (int day = 1; day <= days[month - 1]; ++day)
            for (int hour = 1; hour <= 24; ++hour, ++number) {
                const WeatherOfHour is = of(number);
                text += "2001," + std::to_string(month) + "," + std::to_string(day) + "," +
                        std::to_string(hour) + ",0,?9,15.0,10.0,70,101325,0,0,300,0," +
                        std::to_string(is.direct) + "," + std::to_string(is.diffuse) + ",0," +
                        std::to_string(is.direct_lux) + "," + std::to_string(is.diffuse_lux) +
                        ",0,180,3.0,5,5,20.0,77777,9,999999999,200,0.1,0,88,0.2,0,0\n";
            }
    return text;
}

}  // namespace lumel::support
