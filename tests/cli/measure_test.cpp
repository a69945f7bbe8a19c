// lumel measure, from outside.

#include <algorithm>
#include <cmath>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/weather_text.h"
#include "edited_scene.h"
#include "jobs/inspect/room_report.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

/// A finished bake.
class MeasuredBake {
public:
    explicit MeasuredBake(const std::string& scene, const std::vector<std::string>& more = {})
    {
        std::vector<std::string> arguments = {"bake", own_scene(scene),  folder(), "--size",
                                              "64",   "--preview-width", "0",      "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }

    std::string folder() const { return place.path("out"); }

    Outcome measure(const std::vector<std::string>& more) const
    {
        std::vector<std::string> arguments = {"measure", folder()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_lumel(arguments);
    }

    Json json(std::vector<std::string> more) const
    {
        more.emplace_back("--json");
        const Outcome outcome = measure(more);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return Json::parse(outcome.out);
    }

    const Workplace place;
};

std::vector<std::string> lines_of(const std::string& text)
{
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

TEST(Measure, AFurnaceHasTheEmissionOverOneMinusTheAlbedoEverywhere)
{
    const MeasuredBake bake("furnace-0.5.gltf", {"--error", "0.2"});
    const Json report = bake.json({"--at", "0.3,0.4,0.5", "--at", "0.5,0,0.2", "--at",
                                   "0.7,0.9,0.6,1,-2,0.5", "--samples", "16384"});
    ASSERT_EQ(report["points"].size(), 3u);
    for (const Json& point : report["points"]) {
        EXPECT_NEAR(point["illuminance"].get<double>(), 1.0 / (1.0 - 0.5), 0.005 * 2.0) << point;
        EXPECT_LT(point["noise"].get<double>(), 0.005 * 2.0);
    }
}

TEST(Measure, APlaneHasAsManyRowsInItsTableAsPoints)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "64"});
    const std::string table = bake.place.path("plane.csv"), picture = bake.place.path("plane.png");
    const Json report = bake.json({"--plane", "0.1", "--spacing", "0.1", "--samples", "256",
                                   "--csv", table, "--false-colour", picture});
    const Json& plane = report["plane"];
    // The blocks stand on the floor.
    EXPECT_GT(plane["left_out"].get<int>(), 0);
    const std::vector<std::string> lines = lines_of(bytes_of(table));
    ASSERT_EQ(lines.size(), report["points"].size() + 1);
    EXPECT_EQ(lines[0], "x_m,y_m,z_m,normal_x,normal_y,normal_z,illuminance_lx,noise_lx");
    double least = 1e30, sum = 0.0;
    int count = 0;
    for (const Json& point : report["points"])
        if (!point["inside"]) {
            const double lux = point["illuminance"];
            least = std::min(least, lux);
            sum += lux;
            ++count;
        }
    EXPECT_EQ(plane["points"], count);
    EXPECT_NEAR(plane["minimum"].get<double>(), least, 1e-9);
    EXPECT_NEAR(plane["mean"].get<double>(), sum / count, 1e-9 * sum);
    EXPECT_NEAR(plane["uniformity"].get<double>(), least / (sum / count), 1e-9);
    EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
    const Outcome table_on_stdout = bake.measure({"--plane", "0.1", "--spacing", "0.1"});
    EXPECT_NE(table_on_stdout.out.find("uniformity"), std::string::npos) << table_on_stdout.out;
    // The same rays each time.
    const std::string first = bytes_of(table);
    bake.json({"--plane", "0.1", "--spacing", "0.1", "--samples", "256", "--csv", table});
    EXPECT_EQ(bytes_of(table), first);
}

TEST(Measure, ThePreviewIsDrawnInFalseColours)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "64"});
    const std::string picture = bake.place.path("view.png");
    const Outcome outcome = bake.measure({"--preview", picture, "--width", "96"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(bytes_of(picture).substr(1, 3), "PNG");
}

TEST(Measure, GivesDaylightFactorsOfABakeUnderAnOvercastSkyAlone)
{
    const MeasuredBake bake("city.gltf", {"--sky", "overcast:5000", "--shots", "64"});
    // Far above the roofs.
    const Json report = bake.json({"--at", "0,1000,0", "--samples", "16384"});
    EXPECT_EQ(report["outdoors"], 5000.0);
    EXPECT_NEAR(report["points"][0]["daylight_factor"].get<double>(), 100.0, 0.5);
    EXPECT_NEAR(report["points"][0]["illuminance"].get<double>(), 5000.0, 25.0);
    const MeasuredBake standard("city.gltf", {"--sky", "cie:1", "--shots", "64"});
    const Json open = standard.json({"--at", "0,1000,0", "--samples", "16384"});
    EXPECT_NEAR(open["points"][0]["daylight_factor"].get<double>(), 100.0, 0.5);
    const MeasuredBake lit("cornell-box.gltf", {"--sky", "overcast", "--shots", "64"});
    const Json mixed = lit.json({"--at", "0.2,0.2,0.2"});
    EXPECT_FALSE(mixed["points"][0].contains("daylight_factor"));
    EXPECT_EQ(mixed["notes"].size(), 1u);
}

TEST(Measure, APlaneOutsideOfTheSceneIsAWarning)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "16"});
    for (const std::vector<std::string>& outside :
         {std::vector<std::string>{"--plane", "50"},
          std::vector<std::string>{"--plane", "0.2", "--bounds", "7,7,8,8"}})
        EXPECT_TRUE(has(bake.measure(outside).err, "the plane is outside of the scene"));
    EXPECT_EQ(bake.measure({"--plane", "0.2"}).err, "");
}

TEST(Measure, RefusesWhatItCannotUse)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "16"});
    const auto refused = [&](const std::vector<std::string>& more,
                             const std::vector<std::string>& words) {
        expect_one_sentence(bake.measure(more), 2, words);
    };
    refused({}, {"--at", "--plane"});
    refused({"--at", "1,2"}, {"--at", "X,Y,Z"});
    refused({"--at", "1,2,nan"}, {"--at", "X,Y,Z"});
    refused({"--at", "1,2,3,0,0,0"}, {"--at", "normal"});
    refused({"--at", "1,2,3", "--plane", "1"}, {"--plane", "--at"});
    refused({"--plane", "high"}, {"--plane"});
    refused({"--plane", "1", "--spacing", "0"}, {"--spacing"});
    refused({"--plane", "1", "--spacing", "1e-6"}, {"--spacing", "million"});
    refused({"--plane", "1", "--bounds", "1,1,0,2"}, {"--bounds"});
    refused({"--at", "1,2,3", "--spacing", "1"}, {"--spacing", "--plane"});
    refused({"--at", "1,2,3", "--false-colour", "a.png"}, {"--false-colour", "--plane"});
    refused({"--at", "1,2,3", "--samples", "1"}, {"--samples"});
    expect_one_sentence(run_lumel({"measure", bake.place.path("none"), "--at", "0,0,0"}), 2,
                        {"none"});
    expect_one_sentence(
        run_lumel({"bake", own_scene("city.gltf"), bake.place.path("x"), "--sky", "overcast:-1"}),
        2, {"--sky", "overcast:LUX"});
}

/// Overcast days of which those before April have 100 lx outdoors, the others 20,000 lx.
std::string two_seasons()
{
    constexpr int kWinterHours = 24 * 90;
    return support::weather_text([](int hour) {
        return hour < kWinterHours
                   ? support::WeatherOfHour{.diffuse = 1.0, .diffuse_lux = 100.0}
                   : support::WeatherOfHour{.diffuse = 200.0, .diffuse_lux = 20000.0};
    });
}

TEST(Measure, DaylightOverAYearIsListedWithItsPlane)
{
    const MeasuredBake bake("office.gltf", {"--shots", "48"});
    const std::string weather = bake.place.file("made.epw", two_seasons());
    const std::string table = bake.place.path("plane.csv");
    const std::vector<std::string> command = {
        "--plane", "0.85",      "--bounds", "0.5,1.5,1.5,3.5", "--spacing", "0.5",    "--samples",
        "1024",    "--weather", weather,    "--hours",         "10-16",     "--hour", "06-21T12",
        "--csv",   table};
    const Json report = bake.json(command);
    EXPECT_EQ(report["year"]["hours"], 6 * 365);
    EXPECT_EQ(report["year"]["target"], 300.0);
    ASSERT_EQ(report["points"].size(), 8u);
    for (const Json& point : report["points"]) {
        // Near the window a few per cent of 20,000 lx are enough, and of 100 lx are not.
        EXPECT_GT(point["daylight_factor"].get<double>(), 1.5) << point;
        EXPECT_LT(point["daylight_factor"].get<double>(), 40.0) << point;
        EXPECT_NEAR(point["year"]["autonomy"].get<double>(), 100.0 * 275.0 / 365.0, 1e-9);
        // Overcast, so that it is nearly the daylight factor.
        const Json& hour = point["year"]["hour"];
        EXPECT_NEAR(hour["illuminance"].get<double>(),
                    200.0 * point["daylight_factor"].get<double>(),
                    0.15 * hour["illuminance"].get<double>());
        EXPECT_LT(hour["noise"].get<double>(), 0.1 * hour["illuminance"].get<double>());
        EXPECT_NEAR(point["year"]["useful"]["below_100"].get<double>(), 100.0 * 90.0 / 365.0, 1e-9);
    }
    EXPECT_EQ(report["plane"]["sufficient_daylight"], 100.0);
    const std::vector<std::string> lines = lines_of(bytes_of(table));
    ASSERT_EQ(lines.size(), 9u);
    EXPECT_TRUE(lines[0].ends_with(
        ",daylight_factor_percent,autonomy_percent,useful_below_100_percent,"
        "useful_100_to_300_percent,useful_300_to_3000_percent,useful_above_3000_percent,"
        "mean_daylight_lx,hour_lx,hour_noise_lx,hour_interpolation_lx"))
        << lines[0];
    for (const std::string& line : lines)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 17) << line;
    // The columns from the daylight factor on are the numbers of the JSON.
    std::vector<double> columns;
    std::istringstream row(lines[1]);
    for (std::string column; std::getline(row, column, ',');)
        columns.push_back(std::stod(column));
    const Json& first = report["points"][0];
    const Json &year = first["year"], &useful = year["useful"];
    const std::vector<Json> numbers = {first["daylight_factor"], year["autonomy"],
                                       useful["below_100"],      useful["100_to_300"],
                                       useful["300_to_3000"],    useful["above_3000"],
                                       year["mean_illuminance"], year["hour"]["illuminance"],
                                       year["hour"]["noise"],    year["hour"]["interpolation"]};
    ASSERT_EQ(columns.size(), 8 + numbers.size());
    for (std::size_t k = 0; k < numbers.size(); ++k)
        EXPECT_NEAR(columns[8 + k], numbers[k].get<double>(), 1e-5 * std::abs(columns[8 + k])) << k;
    const Outcome printed = bake.measure(command);
    for (const char* words :
         {"\ndaylight over the year: mean daylight factor ",
          "sDA 300 lx, 50 % of 2190 hours: 100.0 % of the points",
          "weather of Test (47.50° N, 19.00° E): 2190 hours from 10 to 16 o'clock; 2190 with the "
          "illuminance of the file, 0 with luminous efficacy by Perez et al. 1990, 0 dark"})
        EXPECT_NE(printed.out.find(words), std::string::npos) << printed.out;
    EXPECT_EQ(printed.out.find("outdoors"), std::string::npos);
}

/// A floor goes on around a closed box, dark inside. Of the points, 2 × 2 are in the box.
TEST(Measure, PointsOutdoorsAreNoPartOfTheDaylightOfARoom)
{
    const MeasuredBake bake("sealed-box.gltf", {"--shots", "16"});
    const std::string weather = bake.place.file("made.epw", two_seasons());
    const auto command = [&](const std::string& bounds) {
        return std::vector<std::string>{"--plane",   "0.5",   "--spacing", "0.6",
                                        "--bounds",  bounds,  "--samples", "1024",
                                        "--weather", weather, "--hours",   "12-14"};
    };
    const std::string all = "-1.2,-1.2,3,3", outside = "1,1,2.2,2.2";
    const Json plane = bake.json(command(all))["plane"];
    EXPECT_EQ(plane["points"], 7 * 7);
    EXPECT_EQ(plane["left_out_outdoors"], 7 * 7 - 2 * 2);
    EXPECT_EQ(plane["sufficient_daylight"], 0.0);
    EXPECT_EQ(plane["mean_daylight_factor"], 0.0);
    const Outcome printed = bake.measure(command(all));
    EXPECT_NE(printed.out.find("\nleft out of these: 45 points that are outdoors; see --bounds"),
              std::string::npos)
        << printed.out;
    EXPECT_FALSE(bake.json(command(outside))["plane"].contains("sufficient_daylight"));
    EXPECT_NE(bake.measure(command(outside)).out.find("no figures, as all points are outdoors"),
              std::string::npos);
}

TEST(Measure, AWeatherFileCutShortIsOneSentenceAndNothingIsWritten)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "16"});
    const std::string whole = two_seasons();
    const std::string cut = bake.place.file("cut.epw", whole.substr(0, whole.size() / 2));
    const std::string weather = bake.place.file("whole.epw", whole);
    const std::vector<std::string> before = bake.place.listing();
    const auto refused = [&](const std::vector<std::string>& more,
                             const std::vector<std::string>& words) {
        expect_one_sentence(bake.measure(more), 2, words);
        EXPECT_EQ(bake.place.listing(), before);
    };
    refused({"--at", "0,0.3,0", "--weather", cut, "--csv", bake.place.path("x.csv")},
            {"cut.epw: line", "cut short"});
    refused({"--at", "0,0.3,0", "--weather", bake.place.path("nowhere.epw")}, {"nowhere.epw"});
    refused({"--weather", cut}, {"--at"});
    refused({"--at", "0,0.3,0", "--hours", "8-18"}, {"--hours", "--weather"});
    refused({"--at", "0,0.3,0", "--weather", weather, "--hour", "06-21T22"},
            {"--hour", "06-21T22"});
    for (const char* hour : {"06-21T09", "06-21T16"})
        refused({"--at", "0,0.3,0", "--weather", weather, "--hours", "10-16", "--hour", hour},
                {"--hour", hour});
    for (const char* hour :
         {"6", "06-21", "13-01T12", "06-21T24", "06-21T12:00", "+6-21T12", " 6-21T12", "6-21T12"})
        refused({"--at", "0,0.3,0", "--weather", cut, "--hour", hour}, {"--hour", "MM-DDTHH"});
    for (const char* hours :
         {"18-8", "8", "8-25", "8.5-18", "a-b", "8-", "-18", "+8-18", " 8-18", "8e0-18"})
        refused({"--at", "0,0.3,0", "--weather", cut, std::string("--hours=") + hours},
                {"--hours", "FROM-TO"});
}

// Inside of the box shines its lamp, outside a bulb; its left wall is a sheet whose two sides have
// lumels of their own.
TEST(Measure, BothSidesOfAWallHaveTheLightOfTheirOwnLamps)
{
    EditedScene scene("cornell-box.gltf");
    for (Json& material : scene.json()["materials"])
        material["doubleSided"] = true;
    scene.json()["extensionsUsed"].push_back("KHR_lights_punctual");
    scene.json()["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"intensity", 10.0}, {"name", "bulb"}}};
    const int bulb =
        scene.push("nodes", {{"name", "bulb"},
                             {"translation", {-1.0, 0.3, 0.0}},
                             {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    scene.json()["scenes"][0]["nodes"].push_back(bulb);
    const Workplace place;
    ASSERT_EQ(run_lumel({"bake", scene.write(place), place.path("out"), "--size", "128",
                         "--preview-width", "0", "--per-lamp", "-q"})
                  .code,
              0);
    const RoomOptions options{.use = "office",
                              .height = 0.3,
                              .bounds = std::array{-0.8, -0.2, -0.4, 0.2},
                              .illuminance = 1.0};
    const Json room = room_data(place.path("out"), options);
    const Json lamps = Json::parse(bytes_of(place.path("out/lamps.json")))["lamps"];
    ASSERT_EQ(lamps.size(), 2u);
    const std::size_t outside = lamps[0]["name"] == "bulb" ? 0 : 1;
    double bulb_lux = 0.0, lamp_lux = 0.0;
    for (const Json& of_lamps : room["areas"][0]["lux"]) {
        bulb_lux += of_lamps[outside].get<double>();
        lamp_lux += of_lamps[1 - outside].get<double>();
    }
    EXPECT_GT(bulb_lux, 0.0);
    EXPECT_LT(lamp_lux, 0.01 * bulb_lux);
}

TEST(Measure, RoomsThatCannotBeReportedAreRefused)
{
    const MeasuredBake bake("cornell-box.gltf", {"--shots", "16"});
    const auto refused = [&](const std::vector<std::string>& more,
                             const std::vector<std::string>& words) {
        std::vector<std::string> command = {"report", bake.place.path("out")};
        command.insert(command.end(), more.begin(), more.end());
        expect_one_sentence(run_lumel(command), 2, words);
    };
    refused({"--en12464", "ofice"}, {"ofice", "office"});
    refused({"--task", "0,0,1,1"}, {"--task", "--en12464"});
    refused({"--en12464", "office", "--task", "0,0,9,9"}, {"--task", "within"});
    refused({"--en12464", "office", "--task", "1,1,0,0"}, {"--task", "X0 < X1"});
    refused({"--en12464", "office", "--bounds", "-1e6,-1e6,1e6,1e6"}, {"--bounds", "10,000"});
    refused({"--en12464", "office", "--plane", "50"}, {"--plane", "outside"});
    refused({"--en12464", "office", "--maintenance", "1.5"}, {"--maintenance"});
}

}  // namespace
}  // namespace lumel::test
