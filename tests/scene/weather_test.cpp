// Weather files, the sky of their hours, and its patches.

#include <cmath>
#include <numbers>
#include <regex>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "../support/input_error.h"
#include "../support/weather_text.h"
#include "scene/sky/cie_sky.h"
#include "scene/sky/perez_sky.h"
#include "scene/sky/sky_patches.h"
#include "scene/sky/sun.h"
#include "scene/sky/weather_file.h"

using namespace lumel;
using namespace lumel::test;
using support::weather_text;
using support::WeatherOfHour;

namespace {

Weather weather_of(const std::string& text)
{
    return read_weather(Bytes(text.begin(), text.end()), "year.epw");
}

std::string error_of(const std::string& text)
{
    return input_error_of([&] { weather_of(text); });
}

const std::string& even_year()
{
    static const std::string text = weather_text([](int) {
        return WeatherOfHour{500.0, 100.0, 50000.0, 11000.0};
    });
    return text;
}

/// The even year with a change in the line of its first hour.
std::string changed(const std::string& from, const std::string& to)
{
    std::string text = even_year();
    text.replace(text.find(from, text.find("\n2001,") + 1), from.size(), to);
    return text;
}

PerezSky sky_of(double direct, double diffuse, double elevation)
{
    return {{.direct = direct, .diffuse = diffuse, .day_of_year = 91, .dew_point = 11.0},
            {0.0, glm::radians(elevation)}};
}

}  // namespace

TEST(Weather, HasTheHoursAndThePlaceOfItsFile)
{
    const Weather weather = weather_of(weather_text([](int hour) {
        return WeatherOfHour{double(hour % 1000), 0.1 * (hour % 1000), 100.0 * (hour % 1000), 1.0};
    }));
    ASSERT_EQ(weather.hours.size(), 8760u);
    EXPECT_EQ(weather.city, "Test");
    EXPECT_NEAR(weather.latitude, glm::radians(47.5), 1e-9);
    EXPECT_NEAR(weather.longitude, glm::radians(19.0), 1e-9);
    EXPECT_EQ(weather.missing, 0u);
    const WeatherHour& hour = weather.hours[24 * 31 + 12];  // 1 February, 12 to 13
    EXPECT_EQ(hour.ends, 13);
    EXPECT_EQ(hour.day_of_year, 32);
    EXPECT_EQ(hour.direct, 756.0);
    EXPECT_NEAR(hour.diffuse, 75.6, 1e-6);
    EXPECT_TRUE(hour.has_illuminance);
    EXPECT_EQ(hour.direct_lux, 75600.0);
    EXPECT_EQ(hour.middle, seconds_since_2000("2001-02-01T12:30+01:00"));
}

/// At Greenwich on 21 June the sun rises at 3:43 and is highest at 12:02 UTC.
TEST(Weather, TheSunIsThatOfTheMiddleOfItsHours)
{
    const Weather weather = weather_of(
        weather_text([](int) { return WeatherOfHour{.diffuse = 1.0}; }, 51.4779, 0.0, 0.0));
    const std::size_t day = 24 * 171;  // 21 June
    const auto elevation = [&](std::size_t hour) {
        return glm::degrees(
            sun_position(weather.latitude, weather.longitude, weather.hours[day + hour].middle)
                .elevation);
    };
    EXPECT_LT(elevation(2), -5.0);  // 2:30, over an hour before it rises
    EXPECT_GT(elevation(4), 4.0);   // 4:30
    EXPECT_NEAR(elevation(11), elevation(12), 0.3);
    EXPECT_NEAR(elevation(11), 90.0 - 51.4779 + 23.44, 1.5);
}

TEST(Weather, MayHaveALeapDay)
{
    std::string text = even_year();
    const std::size_t from = text.find("\n2001,2,28,1,") + 1, to = text.find("\n2001,3,1,1,") + 1;
    std::string day = text.substr(from, to - from);
    for (std::size_t at = 0; (at = day.find("2001,2,28,", at)) != day.npos;)
        day.replace(at, 10, "2001,2,29,");
    const Weather weather = weather_of(text.insert(to, day));
    ASSERT_EQ(weather.hours.size(), 8784u);
    EXPECT_EQ(weather.hours[24 * 59].day_of_year, 60);
}

/// Decided in each hour: a mark in both columns, or 0 lx of sun or sky in bright hours.
TEST(Weather, WithoutIlluminanceIsReadByItsRadiation)
{
    const WeatherOfHour whole{500.0, 100.0, 50000.0, 11000.0};
    const WeatherOfHour lacking[] = {{500.0, 100.0, 0.0, 0.0},
                                     {500.0, 100.0, 999999.0, 999999.0},
                                     {500.0, 100.0, 0.0, 11000.0},
                                     {500.0, 100.0, 50000.0, 0.0},
                                     {10.0, 10.0, 999999.0, 1000.0}};
    for (const WeatherOfHour& lacks : lacking) {
        const Weather weather =
            weather_of(weather_text([&](int hour) { return hour == 12 ? lacks : whole; }));
        EXPECT_FALSE(weather.hours[12].has_illuminance);
        EXPECT_EQ(weather.hours[12].diffuse, lacks.diffuse);
        EXPECT_TRUE(weather.hours[13].has_illuminance);
    }
    // Dusk is dark, and a grey hour has no sun.
    for (const WeatherOfHour& has :
         {WeatherOfHour{0.0, 10.0, 0.0, 0.0}, WeatherOfHour{0.0, 100.0, 0.0, 11000.0}})
        EXPECT_TRUE(weather_of(weather_text([&](int) { return has; })).hours[12].has_illuminance);
    const Weather gap = weather_of(weather_text([](int hour) {
        return WeatherOfHour{hour == 7 ? 9999.0 : 500.0, 100.0, 50000.0, 11000.0};
    }));
    EXPECT_EQ(gap.missing, 1u);
    EXPECT_EQ(gap.hours[7].diffuse, 0.0);
}

/// At the equator, half an hour east of the meridian of its time zone, the sun is within 5° of the
/// horizon at 5:30 and 17:30. No hour from 5 to 18 is at night; twelve hours later, all but two
/// are.
TEST(Weather, CountsSunAtNight)
{
    const auto at_night = [](int later) {
        return weather_of(weather_text(
                              [&](int hour) {
                                  const int of_day = (hour + later) % 24;
                                  return of_day >= 5 && of_day < 18 ? WeatherOfHour{500.0, 100.0}
                                                                    : WeatherOfHour{};
                              },
                              0.0, 22.5, 1.0))
            .at_night;
    };
    EXPECT_EQ(at_night(0), 0u);
    EXPECT_EQ(at_night(12), 365u * 11u);
}

TEST(Weather, MayBeginWithAByteOrderMark)
{
    EXPECT_EQ(weather_of("\xEF\xBB\xBF" + even_year()).city, "Test");
}

TEST(Weather, IsRefusedIfItsHoursAreOutOfOrder)
{
    const std::string order = "the hour does not follow that of the line before";
    const auto line_of = [](const char* begin) {
        return even_year().find(std::string("\n2001,") + begin) + 1;
    };
    const auto without = [&](const char* from, const char* to) {
        std::string text = even_year();
        return text.erase(line_of(from), line_of(to) - line_of(from));
    };
    EXPECT_EQ(error_of(without("1,1,2,", "1,1,3,")), "year.epw: line 10: " + order);
    EXPECT_EQ(error_of(without("2,27,1,", "2,28,1,")), "year.epw: line 1377: " + order);
    EXPECT_EQ(error_of(without("4,1,1,", "5,1,1,")), "year.epw: line 2169: " + order);
    EXPECT_EQ(error_of(without("1,1,1,", "1,1,2,")),
              "year.epw: line 9: the first hour of the file is not the first of a day");
    // 28 days of February are enough, 27 and 30 are not.
    EXPECT_EQ(error_of(without("2,28,1,", "3,1,1,")), "year.epw: line 1401: " + order);
    std::string text = even_year();
    text.replace(line_of("4,30,24,"), 13, "2001,4,31,24,");
    EXPECT_EQ(error_of(text), "year.epw: line 2888: the day 31 is not between 1 and 30");
    text = even_year();
    text.replace(line_of("3,1,1,"), 11, "2001,2,30,1,");
    EXPECT_EQ(error_of(text), "year.epw: line 1425: the day 30 is not between 1 and 29");
}

TEST(Weather, IsRefusedInTheDarkAndInAnotherTimeZone)
{
    const auto even = [](int) { return WeatherOfHour{500.0, 100.0}; };
    EXPECT_EQ(error_of(weather_text([](int) { return WeatherOfHour{}; })),
              "year.epw: line 8768: no hour of the file has radiation of sun or sky");
    EXPECT_EQ(error_of(weather_text(even, 47.5, -19.0, 2.0)),
              "year.epw: line 1: the longitude -19.000000 is not in the time zone 2.000000: its "
              "noon is more than 3 hours off");
    // The west of China, and islands on the other side of the date line.
    EXPECT_EQ(weather_of(weather_text(even, 39.5, 75.9, 8.0)).hours.size(), 8760u);
    EXPECT_EQ(weather_of(weather_text(even, 1.9, -157.4, 14.0)).hours.size(), 8760u);
}

TEST(Weather, IsRefusedWithTheLineAtFault)
{
    const std::string& whole = even_year();
    const std::size_t middle = whole.find("\n2001,7,1,1,") + 1;
    EXPECT_EQ(error_of(whole.substr(0, middle)),
              "year.epw: line 4352: the file ends after 4344 hours of 8760: it is cut short");
    EXPECT_EQ(error_of(whole.substr(0, middle + 40)),
              "year.epw: line 4353: has 13 columns, but an hour has 35: the file is cut short");
    EXPECT_EQ(error_of(changed(",0.1,0,88,0.2,0,0", ",0.1")),
              "year.epw: line 9: has 30 columns, but an hour has 35: the file is cut short");
    EXPECT_EQ(error_of("LOCATION,Test,-,-,made,0,47,19,1,100\nCOMMENTS 1\n"),
              "year.epw: line 2: the file ends in its header");
    EXPECT_EQ(error_of(whole.substr(whole.find("DESIGN"))),
              "year.epw: line 1: is not a weather file: an EPW file begins with LOCATION, the city "
              "and its latitude, longitude and time zone");
    EXPECT_EQ(error_of(changed("500.0", "many")),
              "year.epw: line 9: \"many00000\" in column 15 is not a number, but the direct normal "
              "radiation must be");
    EXPECT_EQ(error_of(changed("500.0", "-50.0")),
              "year.epw: line 9: the direct normal radiation is below 0");
    EXPECT_EQ(error_of(changed("2001,1,1,1,", "2001,13,1,1,")),
              "year.epw: line 9: the month 13 is not between 1 and 12");
    EXPECT_EQ(error_of(changed("2001,1,1,1,", "2001,1,1,1.5,")),
              "year.epw: line 9: the hour must be a whole number");
    const std::string rows = whole.substr(whole.find("\n2001,1,1,1,") + 1);
    EXPECT_EQ(error_of(whole + rows), "year.epw: line 8793: the file has more hours than a year");
    std::string quarters = whole;
    quarters.replace(quarters.find("DATA PERIODS,1,1"), 16, "DATA PERIODS,1,4");
    EXPECT_EQ(error_of(quarters),
              "year.epw: line 8: the file has more than one record per hour; one is read");
}

TEST(SkyPatches, AreTheHemisphere)
{
    EXPECT_EQ(SkyPatches().count(), 145u);
    for (const std::size_t division : {1u, 2u, 4u}) {
        const SkyPatches patches(division);
        double angle = 0.0, projected = 0.0;
        std::vector<double> parts(145, 0.0);
        for (std::size_t k = 0; k < patches.count(); ++k) {
            angle += patches.solid_angle(k);
            projected += patches.projected(k);
            parts[patches.whole(k)] += patches.solid_angle(k);
        }
        EXPECT_NEAR(angle, 2.0 * std::numbers::pi, 1e-12);
        EXPECT_NEAR(projected, std::numbers::pi, 1e-12);
        for (std::size_t k = 0; k < parts.size(); ++k)
            EXPECT_NEAR(parts[k], SkyPatches().solid_angle(k), 1e-12) << k;
    }
}

/// The mean over each patch of its own number is that number, if at() and the patches agree.
TEST(SkyPatches, AreFoundByDirection)
{
    for (const std::size_t division : {1u, 2u}) {
        const SkyPatches patches(division);
        const std::vector<double> numbers =
            patches.means([&](const glm::dvec3& to) { return double(patches.at(glm::vec3(to))); });
        const std::vector<double> wholes = patches.means(
            [](const glm::dvec3& to) { return double(SkyPatches().at(glm::vec3(to))); });
        for (std::size_t k = 0; k < patches.count(); ++k) {
            EXPECT_EQ(numbers[k], double(k));
            EXPECT_EQ(wholes[k], double(patches.whole(k)));
        }
    }
    const SkyPatches patches;
    EXPECT_EQ(patches.at({0.0f, -0.01f, 1.0f}), SkyPatches::kNone);
    EXPECT_EQ(patches.at({0.0f, 1.0f, 0.0f}), 144u);
    EXPECT_EQ(patches.at(glm::normalize(glm::vec3(0.0f, 0.1f, -1.0f))), 0u);  // north
    EXPECT_EQ(patches.at(glm::normalize(glm::vec3(1.0f, 0.1f, 0.0f))), 8u);   // east: 90° / 12°
}

TEST(SkyPatches, GiveAnOpenPlaneTheLightOfTheOvercastSky)
{
    // ∫ (1 + 2 cos Z) cos Z dω = 7π/3
    const SkyPatches patches(2);
    const std::vector<double> luminance =
        patches.means([](const glm::dvec3& to) { return cie_luminance(kOvercastType, to.y, 0.0); });
    double sum = 0.0;
    for (std::size_t k = 0; k < luminance.size(); ++k)
        sum += luminance[k] * patches.projected(k);
    EXPECT_NEAR(sum, 7.0 * std::numbers::pi / 3.0, 0.002 * 7.0 * std::numbers::pi / 3.0);
}

/// [PISMS90] (1), (2), (7) and (8) by hand, for the sun at 30°: Z = π/3, 1.041 Z³ = 1.19544,
/// m = 1.994, W = 2.0038 cm.
TEST(PerezSky, HasTheClearnessBrightnessAndEfficacyOfItsEquations)
{
    const PerezSky clear = sky_of(800.0, 80.0, 30.0);
    EXPECT_NEAR(clear.clearness(), (11.0 + 1.19544) / 2.19544, 1e-4);  // 5.555: bin 7
    EXPECT_NEAR(clear.brightness(), 1.994 * 80.0 / 1367.0, 2e-4);
    EXPECT_NEAR(clear.diffuse_efficacy(),
                141.88 + 1.90 * 2.0038 - 53.24 * 0.5 - 14.03 * std::log(1.994 * 80.0 / 1367.0),
                0.05);
    EXPECT_NEAR(clear.direct_efficacy(),
                105.75 + 0.77 * 2.0038 - 1.26 * std::exp(5.73 * std::numbers::pi / 3.0 - 5.0) -
                    34.44 * 1.994 * 80.0 / 1367.0,
                0.05);
    EXPECT_EQ(sky_of(0.0, 100.0, 30.0).clearness(), 1.0);
    // The mean of clear days by the IES and this agree within what skies differ.
    EXPECT_NEAR(clear.direct_efficacy(), 100.0, 10.0);
    EXPECT_NEAR(sky_of(0.0, 150.0, 40.0).diffuse_efficacy(), 115.0, 10.0);
}

TEST(PerezSky, IsBrightestAboutAClearSunAndAtAnOvercastZenith)
{
    const PerezSky clear = sky_of(850.0, 70.0, 40.0), overcast = sky_of(0.0, 0.01, 40.0);
    const double at_zenith = glm::radians(50.0);
    EXPECT_GT(clear.luminance(std::cos(at_zenith), glm::radians(3.0)),
              8.0 * clear.luminance(1.0, at_zenith));
    // Darkest about a right angle from the sun.
    const auto across = [&](double elevation) {  // on the sun's meridian, beyond the zenith
        return clear.luminance(std::sin(glm::radians(elevation)),
                               glm::radians(180.0 - 40.0 - elevation));
    };
    EXPECT_LT(across(50.0), across(10.0));
    EXPECT_LT(across(50.0), clear.luminance(std::sin(glm::radians(60.0)), glm::radians(20.0)));
    // By hand for the least Δ, 0.01, and Z = 50°: a = 1.1125, b = -0.7547, c = 0.0149, d = -0.0479,
    // e = -0.0702; zenith against 10° at a right angle from the sun.
    const double gradient = overcast.luminance(1.0, at_zenith) /
                            overcast.luminance(std::sin(glm::radians(10.0)), glm::radians(90.0));
    EXPECT_NEAR(gradient, 1.5230 * 0.9853 / (1.0144 * 1.0138), 0.001);
}
