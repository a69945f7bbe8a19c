// Maps of daylight of bakes in memory.

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "boxes.h"
#include "few_days.h"
#include "jobs/bake/bake.h"

namespace lumel::v0 {
namespace {

using namespace test;
using support::WeatherOfHour;

constexpr std::uint32_t kRays = 12;
/// Of daylight.json, which keeps five digits.
constexpr double kRounding = 1e-4;

/// The same days with the illuminance of sky and sun in the file.
WeatherOfHour few_days_with_lux(int hour)
{
    WeatherOfHour made = few_days(hour);
    made.direct_lux = 100.0 * made.direct;
    made.diffuse_lux = 120.0 * made.diffuse;
    return made;
}

void expect_near(double value, double expected)
{
    EXPECT_NEAR(value, expected, kRounding * std::abs(expected));
}

TEST(DaylightOfABake, IsWhatTheProgramWrites)
{
    const lumel::test::TemporaryFolder folder;
    const std::string weather = weather_file(folder, few_days);
    BakeOptions options;
    options.atlas.size = 2 * kSize;
    options.solver.method = LinksOptions{.rays = Rays::host};
    options.solver.max_shots = kRays;
    options.solver.target_error = 0.0;
    options.preview_width = 0;
    options.daylight = weather;
    lumel::bake(scene_path("office"), folder / "out", options);
    const Json written = read_json(folder / "out/daylight.json");

    bool is_told = false;
    const Baked baked = bake(
        Scene::load(scene_path("office")),
        {.atlas = {.size = 2 * kSize}, .weather_file = weather, .shots = kRays},
        [&](const Progress& now) { return is_told = is_told || now.stage == "daylight", true; });
    EXPECT_TRUE(is_told);
    EXPECT_FALSE(baked.interrupted);
    EXPECT_EQ(baked.map.rgba, read_exr(folder / "out/lightmap.exr").values);
    ASSERT_TRUE(baked.daylight);
    const DaylightMaps& daylight = *baked.daylight;
    EXPECT_EQ(daylight.place, "Test");
    expect_near(daylight.latitude, 47.5 * std::numbers::pi / 180.0);
    expect_near(daylight.longitude, 19.0 * std::numbers::pi / 180.0);
    expect_near(daylight.error, written["error"].get<double>());
    ASSERT_EQ(daylight.maps.size(), written["maps"].size());
    EXPECT_GT(daylight.maps.size(), 2u);
    for (std::size_t k = 0; k < daylight.maps.size(); ++k) {
        const Json& file = written["maps"][k];
        EXPECT_EQ(daylight.maps[k].hour, file["hour"]);
        EXPECT_EQ(daylight.maps[k].map.rgba,
                  read_exr(folder / "out/" + file["map"].get<std::string>()).values);
    }
    ASSERT_EQ(daylight.hours.size(), written["hours"].size());
    EXPECT_EQ(daylight.hours.size(), 4u * 12u);
    for (std::size_t h = 0; h < daylight.hours.size(); ++h) {
        const DaylightHour& hour = daylight.hours[h];
        const Json& row = written["hours"][h];
        EXPECT_EQ(hour.hour, row["hour"]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(hour.sun[axis], row["sun"][axis].get<float>(), kRounding);
        expect_near(double(hour.lux), row["lux"].get<double>());
        expect_near(hour.mean, row["mean"].get<double>());
        expect_near(hour.error, row["error"].get<double>());
        ASSERT_EQ(hour.weights.size(), daylight.maps.size());
        for (std::size_t k = 0; k < hour.weights.size(); ++k)
            expect_near(double(hour.weights[k]), row["weights"][k].get<double>());
    }
}

/// A black square that faces up: the sum of the maps is the light of the sky in each hour.
TEST(DaylightOfABake, AddsUpToTheSkyOfEachHour)
{
    const lumel::test::TemporaryFolder folder;
    SceneContent content;
    content.materials = {{.base_color = {0, 0, 0, 1}}};
    content.meshes = {
        {.primitives = {{.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                         .indices = {0, 1, 2, 0, 2, 3}}}}};
    content.instances = {{.name = "ground"}};
    const Baked baked =
        bake(Scene(content), {.atlas = {.size = 16},
                              .weather_file = weather_file(folder, few_days_with_lux),
                              .shots = kRays});
    ASSERT_TRUE(baked.daylight);
    ASSERT_EQ(baked.daylight->hours.size(), 4u * 12u);
    for (std::size_t h = 0; h < baked.daylight->hours.size(); ++h) {
        const DaylightHour& hour = baked.daylight->hours[h];
        // From 10 to 14 o'clock on days 15, 45, …
        const WeatherOfHour given =
            few_days_with_lux(int(kHoursOfDay * (15 + 30 * (h / 4)) + 10 + h % 4));
        EXPECT_EQ(hour.lux, float(given.direct_lux));
        EXPECT_NEAR(hour.mean, given.diffuse_lux, 0.02 * given.diffuse_lux) << hour.hour;
        double sum = 0.0;
        for (std::size_t k = 0; k < hour.weights.size(); ++k)
            sum += double(hour.weights[k]) * mean_of(baked.daylight->maps[k].map);
        EXPECT_NEAR(sum, hour.mean, 0.01 * hour.mean) << hour.hour;
    }
}

TEST(DaylightOfABake, IsNotThereIfItIsStoppedBefore)
{
    const lumel::test::TemporaryFolder folder;
    const BakeSettings settings{
        .atlas = {.size = kSize}, .weather_file = weather_file(folder, few_days), .shots = kRays};
    const Scene scene = Scene::load(scene_path("cornell-box"));
    const Baked baked =
        bake(scene, settings, [](const Progress& now) { return now.stage != "daylight"; });
    EXPECT_TRUE(baked.interrupted);
    EXPECT_FALSE(baked.daylight);
    EXPECT_EQ(baked.map.rgba, bake(scene, {.atlas = settings.atlas, .shots = kRays}).map.rgba);
    ASSERT_FALSE(baked.notes.empty());
    EXPECT_EQ(baked.notes.back(), "the bake was stopped before the maps of daylight were made");
}

TEST(DaylightOfABake, IsNotThereInAClosedRoom)
{
    const lumel::test::TemporaryFolder folder;
    const Baked baked = bake(
        Scene(closed_cube({.emitted = {1, 1, 1}})),
        {.atlas = {.size = kSize}, .weather_file = weather_file(folder, few_days), .shots = kRays});
    EXPECT_FALSE(baked.daylight);
    EXPECT_FALSE(baked.interrupted);
    ASSERT_FALSE(baked.notes.empty());
    EXPECT_EQ(baked.notes.back(), "no daylight reaches any surface: there are no maps of it");
}

TEST(DaylightOfABake, IsRefusedBySentencesThatNameItsSetting)
{
    const lumel::test::TemporaryFolder folder;
    const Scene scene(closed_cube({.emitted = {1, 1, 1}}));
    const auto refuse = [&](std::initializer_list<const char*> words, BakeSettings settings) {
        settings.atlas.size = kSize;
        expect_error(ErrorKind::input, words, [&] { bake(scene, settings); });
    };
    refuse({"BakeSettings::weather_file: no.epw: "}, {.weather_file = "no.epw"});
    refuse({"BakeSettings::weather_file: ", "made.epw: line 8768: no hour of the file has"},
           {.weather_file = weather_file(folder, [](int) { return WeatherOfHour{}; })});
    const std::string weather = weather_file(folder, few_days);
    for (const Parts parts : {Parts::direct, Parts::indirect})
        refuse({"BakeSettings::weather_file with BakeSettings::parts: is not possible"},
               {.parts = parts, .weather_file = weather});
}

}  // namespace
}  // namespace lumel::v0
