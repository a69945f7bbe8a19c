// The sun, the clear sky, and where they stand.

#include <cmath>

#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "base/core/error.h"
#include "base/core/luminance.h"
#include "scene/sky/clear_sky.h"

using namespace lumel;

namespace {

SunPosition sun_at(double latitude, double longitude, const char* time)
{
    return sun_position(glm::radians(latitude), glm::radians(longitude), seconds_since_2000(time));
}

/// The highest it gets on a day, minute by minute [degrees].
double noon_elevation(double latitude, const std::string& day)
{
    double highest = -90.0;
    for (int minute = 0; minute < 1440; ++minute)
        highest = std::max(
            highest, glm::degrees(sun_position(glm::radians(latitude), 0.0,
                                               seconds_since_2000(day + "T00:00") + 60.0 * minute)
                                      .elevation));
    return highest;
}

}  // namespace

TEST(Sun, StandsAtNoonOfTheSolsticesAsHighAsTheObliquitySays)
{
    // 90° − |latitude − declination|; the obliquity of 2024 is 23.436°.
    EXPECT_NEAR(noon_elevation(51.4769, "2024-06-20"), 90.0 - 51.4769 + 23.436, 0.02);
    EXPECT_NEAR(noon_elevation(51.4769, "2024-12-21"), 90.0 - 51.4769 - 23.436, 0.02);
    EXPECT_NEAR(noon_elevation(-33.87, "2024-12-21"), 90.0 - 33.87 + 23.436, 0.02);
    EXPECT_NEAR(noon_elevation(23.436, "2024-06-20"), 90.0, 0.2);
}

TEST(Sun, KeepsTheEquationOfTime)
{
    // Noon at Greenwich comes 16.4 minutes early on 3 November and 14.2 minutes late on 11
    // February, so the sun stands in the south then.
    EXPECT_NEAR(glm::degrees(sun_at(51.4769, 0.0, "2024-11-03T11:43:34").azimuth), 180.0, 0.1);
    EXPECT_NEAR(glm::degrees(sun_at(51.4769, 0.0, "2024-02-11T12:14:13").azimuth), 180.0, 0.1);
}

TEST(Sun, RisesInTheEastAndSetsInTheWestAtTheEquinox)
{
    const SunPosition morning = sun_at(0.0, 0.0, "2024-03-20T06:08:00Z");
    const SunPosition evening = sun_at(0.0, 0.0, "2024-03-20T18:07:00Z");
    EXPECT_NEAR(glm::degrees(morning.azimuth), 89.95, 0.02);
    EXPECT_NEAR(glm::degrees(morning.elevation), 0.0, 0.5);
    EXPECT_NEAR(glm::degrees(evening.azimuth), 270.25, 0.02);  // the sun is 0.25° north by then
    EXPECT_NEAR(glm::degrees(evening.elevation), 0.0, 0.5);
    // The same sun stands higher for those who live farther east.
    EXPECT_GT(sun_at(0.0, 30.0, "2024-03-20T06:08:00Z").elevation, 0.5);
}

TEST(Sun, NorthIsMinusZAndEastIsX)
{
    const auto near = [](const glm::vec3& a, const glm::vec3& b) {
        return glm::distance(a, b) < 1e-6f;
    };
    EXPECT_TRUE(near(direction_of({0.0, 0.0}), {0, 0, -1}));
    EXPECT_TRUE(near(direction_of({glm::radians(90.0), 0.0}), {1, 0, 0}));
    EXPECT_TRUE(near(direction_of({glm::radians(180.0), 0.0}), {0, 0, 1}));
    EXPECT_TRUE(near(direction_of({1.0, glm::radians(90.0)}), {0, 1, 0}));
}

TEST(Sun, DatesAreReadOrRefused)
{
    EXPECT_EQ(seconds_since_2000("2000-01-01T12:00:00Z"), 0.0);
    EXPECT_EQ(seconds_since_2000("2000-01-02T12:00"), 86400.0);
    EXPECT_EQ(seconds_since_2000("1999-12-31T12:00:07"), -86400.0 + 7.0);
    EXPECT_EQ(seconds_since_2000("2000-03-01T12:00Z"), 60 * 86400.0);
    for (const char* text :
         {"2000-01-01T14:00+02:00", "2000-01-01T14:00:00+0200", "2000-01-01T14:00+02",
          "2000-01-01T05:30-06:30", "2000-01-01T12:00+00:00", "2000-01-02T00:00+12:00"})
        EXPECT_EQ(seconds_since_2000(text), 0.0) << text;
    for (const char* text :
         {"", "noon", "2024-06-21", "2024-02-30T12:00", "2024-06-21T24:00", "2024-06-21T12:60",
          "2024-06-21T12:00+2", "2024-06-21T12:00+02:", "2024-06-21T12:00+02:60",
          "2024-06-21T12:00+15:00", "2024-06-21T12:00 02:00", "2024-06-21T12:00+0a:00",
          "2024-13-01T12:00", "2024-06-21T12:00:00Zulu"})
        EXPECT_THROW(seconds_since_2000(text), Error) << text;
}

TEST(Sun, ADateThatIsNoneIsRefusedInOneLine)
{
    try {
        seconds_since_2000("2024\n06\x1b[31m");
        FAIL() << "was read";
    } catch (const Error& error) {
        for (const char letter : std::string(error.what()))
            EXPECT_GE(static_cast<unsigned char>(letter), ' ');
    }
}

TEST(ClearSky, LightsAPlaneAsThePracticeSays)
{
    for (const double degrees : {2.0, 20.0, 60.0, 90.0}) {
        const double elevation = glm::radians(degrees);
        const double expected = 800.0 + 15500.0 * std::sqrt(std::sin(elevation));
        const Sky sky = clear_sky({1.0, elevation});
        EXPECT_NEAR(luminance(sky_irradiance(sky)), expected, 1e-4 * expected);
        for (const glm::vec3& radiance : sky.radiance)
            ASSERT_TRUE(radiance.r >= 0.0f && radiance.g >= 0.0f && radiance.b >= 0.0f &&
                        std::isfinite(radiance.r + radiance.g + radiance.b));
    }
    EXPECT_NEAR(sun_illuminance(glm::radians(90.0)), 127500.0 * std::exp(-0.21), 1.0);
    EXPECT_EQ(sun_illuminance(0.0), 0.0);
}

TEST(ClearSky, IsBrightestAboutTheSunAndBlueAwayFromIt)
{
    const SunPosition sun{glm::radians(120.0), glm::radians(40.0)};
    const Sky sky = clear_sky(sun);
    const glm::vec3 to_sun = direction_of(sun);
    double brightest = 0.0;
    for (const glm::vec3& radiance : sky.radiance)
        brightest = std::max(brightest, luminance(radiance));
    EXPECT_NEAR(luminance(sky_radiance(sky, to_sun)), brightest, 0.02 * brightest);
    const glm::vec3 away = sky_radiance(sky, glm::normalize(glm::vec3(-to_sun.x, 1.0f, -to_sun.z)));
    EXPECT_GT(away.b, 1.5f * away.r);
    EXPECT_EQ(sky_radiance(sky, {0.1f, -0.9f, 0.1f}), glm::vec3(0.0f));
}

TEST(ClearSky, ZenithAgainstTheSunFollowsTheCieStandard)
{
    // [CIE03] type 12: L(Z, χ) / L(zenith) for the sun at 40°, at Z = 60° opposite the sun.
    const double sun_zenith = glm::radians(50.0), zenith = glm::radians(60.0);
    const auto f = [](double chi) {
        return 1.0 + 10.0 * (std::exp(-3.0 * chi) - std::exp(-1.5 * glm::radians(180.0))) +
               0.45 * std::cos(chi) * std::cos(chi);
    };
    const double expected = f(sun_zenith + zenith) * (1.0 - std::exp(-0.32 / std::cos(zenith))) /
                            (f(sun_zenith) * (1.0 - std::exp(-0.32)));
    const Sky sky = clear_sky({0.0, glm::radians(40.0)});
    const glm::vec3 south(0.0f, float(std::cos(zenith)), float(std::sin(zenith)));
    const double found =
        luminance(sky_radiance(sky, south)) / luminance(sky_radiance(sky, {0, 1, 0}));
    EXPECT_NEAR(found, expected, 0.02 * expected);  // texels of 0.7°
}

TEST(SunLight, ShinesFromTheSunWithItsDisc)
{
    for (const double elevation : {5.0, 40.0, 90.0}) {
        const SunPosition sun{glm::radians(200.0), glm::radians(elevation)};
        const PunctualLight light = sun_light(sun);
        EXPECT_LT(glm::distance(-glm::vec3(light.transform[2]), -direction_of(sun)), 1e-6f);
        EXPECT_NEAR(glm::determinant(glm::mat3(light.transform)), 1.0f, 1e-5f);
        EXPECT_FLOAT_EQ(light.intensity, float(sun_illuminance(sun.elevation)));
        EXPECT_NEAR(glm::degrees(light.angle), 0.2665f, 1e-3f);
    }
}
