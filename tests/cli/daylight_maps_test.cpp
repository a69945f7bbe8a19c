// bake --daylight: maps of hours, of which all hours of a year are sums.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/weather_text.h"
#include "base/images/image_files.h"
#include "program.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Light from 10 to 14 o'clock. february: its days.
std::string short_days(int february = 28)
{
    return support::weather_text(
        [](int hour) {
            const int of_day = hour % 24;
            return of_day < 10 || of_day >= 14
                       ? support::WeatherOfHour{}
                       : support::WeatherOfHour{.direct = hour / 24 % 3 == 0 ? 500.0 : 0.0,
                                                .diffuse = 100.0 + 10.0 * of_day};
        },
        47.5, 19.0, 1.0, february);
}

std::vector<std::string> bake_of_12_rays(const std::string& scene, const std::string& folder,
                                         const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments = {
        "bake", own_scene(scene),  folder, "--size", "64", "--links",
        "12",   "--preview-width", "0",    "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::set<std::string> maps_in(const std::string& folder)
{
    std::set<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder))
        if (const std::string name = entry.path().filename().string();
            name.starts_with("daylight-"))
            found.insert(name);
    return found;
}

}  // namespace

TEST(DaylightFiles, HaveWeightsOfTheirMapsForEachHourWithLight)
{
    const Workplace place;
    const std::string weather = place.file("made.epw", short_days()), out = place.path("out");
    const Outcome baked = run_lumel(bake_of_12_rays("office.gltf", out, {"--daylight", weather}));
    ASSERT_EQ(baked.code, 0) << baked.err;
    const Json daylight = Json::parse(bytes_of(out + "/daylight.json"));
    EXPECT_EQ(daylight["place"]["name"], "Test");
    EXPECT_NEAR(daylight["place"]["latitude"].get<double>(), 47.5, 1e-9);
    EXPECT_LE(daylight["error"].get<double>(), 0.01);
    const Json report = Json::parse(bytes_of(out + "/report.json"));
    EXPECT_EQ(report["settings"]["daylight"], fs::absolute(weather).string());
    const auto files = report["files"].get<std::vector<std::string>>();
    std::set<std::string> named;
    for (const Json& map : daylight["maps"]) {
        named.insert(map["map"].get<std::string>());
        EXPECT_NE(std::find(files.begin(), files.end(), map["map"]), files.end());
        const Image light = read_exr(out + "/" + map["map"].get<std::string>());
        EXPECT_EQ(light.width, 64);
        EXPECT_GE(*std::min_element(light.values.begin(), light.values.end()), 0.0f);
        EXPECT_GT(*std::max_element(light.values.begin(), light.values.end()), 10.0f);
    }
    EXPECT_EQ(named, maps_in(out));
    ASSERT_EQ(daylight["hours"].size(), 4u * 365u);
    std::string before;
    std::size_t own_hours = 0;
    for (const Json& hour : daylight["hours"]) {
        const auto name = hour["hour"].get<std::string>();
        EXPECT_LT(before, name);
        before = name;
        ASSERT_EQ(hour["weights"].size(), daylight["maps"].size());
        const auto sun = hour["sun"].get<std::vector<double>>();
        EXPECT_NEAR(std::hypot(sun[0], sun[1], sun[2]), 1.0, 1e-4);
        EXPECT_GT(sun[2], 0.0) << name;  // in the south: north is -z
        EXPECT_GT(hour["mean"].get<double>(), 0.0);
        EXPECT_GT(hour["error"].get<double>(), 0.0);
        // The light of a map's own hour is the map.
        for (std::size_t k = 0; k < daylight["maps"].size(); ++k)
            if (daylight["maps"][k]["hour"] == name) {
                ++own_hours;
                for (std::size_t j = 0; j < daylight["maps"].size(); ++j)
                    EXPECT_NEAR(hour["weights"][j].get<double>(), j == k ? 1.0 : 0.0, 1e-3);
            }
    }
    EXPECT_EQ(own_hours, daylight["maps"].size());

    // A bake without daylight leaves none of another's.
    ASSERT_EQ(run_lumel(bake_of_12_rays("office.gltf", out)).code, 0);
    EXPECT_TRUE(maps_in(out).empty());
    EXPECT_FALSE(fs::exists(out + "/daylight.json"));
}

/// A leap year, on pages, in 16 bits: what one bake writes, the page reads.
TEST(DaylightFiles, AreOnEachPageOfABakeAndHaveEachDayOfALeapYear)
{
    const Workplace place;
    const std::string weather = place.file("made.epw", short_days(29)), out = place.path("out");
    const Outcome baked =
        run_lumel({"bake", own_scene("office.gltf"), out, "--max-size", "48", "--pages", "4",
                   "--texels-per-metre", "6", "--links", "12", "--preview-width", "0", "--half",
                   "--daylight", weather, "-q"});
    ASSERT_EQ(baked.code, 0) << baked.err;
    const Json daylight = Json::parse(bytes_of(out + "/daylight.json"));
    ASSERT_EQ(daylight["hours"].size(), 4u * 366u);
    const auto is_leap_noon = [](const Json& hour) { return hour["hour"] == "02-29T12"; };
    EXPECT_EQ(std::count_if(daylight["hours"].begin(), daylight["hours"].end(), is_leap_noon), 1);
    const Json report = Json::parse(bytes_of(out + "/report.json"));
    const int pages = report["sizes"]["pages"];
    ASSERT_GT(pages, 1);
    EXPECT_EQ(maps_in(out).size(), std::size_t(pages) * daylight["maps"].size());
    const std::string half_channel("R\0\1\0\0\0", 6);  // name, then type of its values
    for (const Json& map : daylight["maps"]) {
        const auto first = map["map"].get<std::string>();
        ASSERT_TRUE(first.ends_with("-0.exr")) << first;
        for (int page = 0; page < pages; ++page) {
            const std::string name =
                first.substr(0, first.size() - 5) + std::to_string(page) + ".exr";
            const Image light = read_exr(out + "/" + name);
            EXPECT_EQ(light.width, 48) << name;
            EXPECT_GT(*std::max_element(light.values.begin(), light.values.end()), 10.0f) << name;
            EXPECT_NE(bytes_of(out + "/" + name).find(half_channel), std::string::npos) << name;
        }
    }
    const Outcome page = run_lumel({"report", out});
    if (page.err.find("built without three.js") != std::string::npos)
        GTEST_SKIP() << page.err;
    EXPECT_EQ(page.code, 0) << page.err;
}

/// The bake itself is done by then.
TEST(DaylightFiles, AreNoneAfterCtrlCButTheLightmapIs)
{
    const Workplace place;
    const std::string weather = place.file("made.epw", short_days()), out = place.path("out");
    std::vector<std::string> arguments =
        bake_of_12_rays("office.gltf", out, {"--daylight", weather});
    std::erase(arguments, "-q");
    const Outcome baked = run_lumel(arguments, {.interrupt_at = "daylight"});
    EXPECT_EQ(baked.code, 130) << baked.err;
    EXPECT_NE(baked.err.find("stopped before the maps of daylight were made"), std::string::npos)
        << baked.err;
    EXPECT_TRUE(fs::exists(out + "/lightmap.exr"));
    EXPECT_FALSE(fs::exists(out + "/daylight.json"));
    EXPECT_TRUE(maps_in(out).empty());
    EXPECT_TRUE(Json::parse(bytes_of(out + "/report.json"))["solution"]["interrupted"]);
}

TEST(DaylightFiles, AreRefusedInOneSentenceWithoutAWholeYear)
{
    const Workplace place;
    const std::string whole = short_days();
    const std::string cut = place.file("cut.epw", whole.substr(0, whole.size() / 2));
    const std::vector<std::string> before = place.listing();
    expect_one_sentence(
        run_lumel(bake_of_12_rays("office.gltf", place.path("out"), {"--daylight", cut})), 2,
        {"cut.epw: line", "cut short"});
    expect_one_sentence(
        run_lumel(bake_of_12_rays("office.gltf", place.path("out"), {"--daylight", "no.epw"})), 2,
        {"no.epw"});
    EXPECT_EQ(place.listing(), before);
}

TEST(DaylightFiles, AreNoneWhereNoDaylightComesIn)
{
    const Workplace place;
    const std::string weather = place.file("made.epw", short_days()), out = place.path("out");
    const Outcome baked =
        run_lumel(bake_of_12_rays("furnace-0.9.gltf", out, {"--daylight", weather}));
    ASSERT_EQ(baked.code, 0) << baked.err;
    EXPECT_NE(baked.err.find("no daylight reaches any surface"), std::string::npos) << baked.err;
    EXPECT_FALSE(fs::exists(out + "/daylight.json"));
    EXPECT_TRUE(fs::exists(out + "/lightmap.exr"));
}

}  // namespace lumel::test
