// bake --per-lamp: a map for each lamp, which add up to the lightmap.

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/images/image_files.h"
#include "edited_scene.h"
#include "program.h"

namespace lumel::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr const char* kLampsSide = "96";  // of the atlas [texels]

std::vector<std::string> lamps_bake_of(const std::string& scene, const std::string& folder,
                                       const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments = {
        "bake", scene, folder, "--size", kLampsSide, "--links", "12", "--preview-width", "0", "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

Json lamps_in(const std::string& folder)
{
    return Json::parse(bytes_of(folder + "/lamps.json"));
}

/// Largest difference of the sum of `page` of all lamps from that of the lightmap, relative to its
/// texel, or to `floor` if that is larger [lx]; -1 if a lamp is negative.
double error_of_sum(const std::string& folder, const std::string& page = "", double floor = 0.0)
{
    const Image whole = read_exr(folder + "/lightmap" + page + ".exr");
    std::vector<double> sum(whole.values.size(), 0.0);
    const Json lamps = lamps_in(folder);
    for (const Json& lamp : lamps["lamps"]) {
        std::string map = lamp["map"].get<std::string>();
        if (!page.empty())
            map.replace(map.rfind("-0.exr"), 2, page);
        const Image light = read_exr(folder + "/" + map);
        for (std::size_t v = 0; v < sum.size(); ++v) {
            if (light.values[v] < 0.0f)
                return -1.0;
            sum[v] += v % 4 == 3 ? 0.0 : double(light.values[v]);
        }
    }
    double worst = 0.0;
    for (std::size_t v = 0; v < sum.size(); ++v)
        if (v % 4 != 3 && whole.values[v] > 0.0f)
            worst = std::max(worst, std::abs(sum[v] - double(whole.values[v])) /
                                        std::max(double(whole.values[v]), floor));
    return worst;
}

/// The Cornell box with so many bulbs, and a sky.
std::string box_with_bulbs(const Workplace& place, int count)
{
    EditedScene box("cornell-box.gltf");
    Json& json = box.json();
    json["extensionsUsed"].push_back("KHR_lights_punctual");
    Json lights = Json::array();
    for (int k = 0; k < count; ++k) {
        lights.push_back({{"type", "point"},
                          {"name", "bulb " + std::to_string(k)},
                          {"intensity", 0.02 * double(1 + k)}});
        const int node =
            box.push("nodes", {{"name", "bulb " + std::to_string(k)},
                               {"translation", {0.1 + 0.005 * k, 0.3, 0.1}},
                               {"extensions", {{"KHR_lights_punctual", {{"light", k}}}}}});
        json["scenes"][0]["nodes"].push_back(node);
    }
    json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
    return box.write(place);
}

TEST(PerLamp, MapsAddUpInEverySceneOfTheProject)
{
    std::size_t scenes = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(own_scene("room.gltf")).parent_path())) {
        if (entry.path().extension() != ".gltf")
            continue;
        const Workplace place;
        const Outcome outcome =
            run_lumel(lamps_bake_of(entry.path().string(), place.path("out"), {"--per-lamp"}));
        if (outcome.code != 0) {
            EXPECT_NE(outcome.err.find("has no lamp whose light can be kept apart"),
                      std::string::npos)
                << entry.path() << ": " << outcome.err;
            continue;
        }
        ++scenes;
        const double apart = error_of_sum(place.path("out"));
        EXPECT_GE(apart, 0.0) << entry.path();
        EXPECT_LT(apart, 1e-5) << entry.path();
        EXPECT_LT(lamps_in(place.path("out"))["sum_error"].get<double>(), 1e-5) << entry.path();
    }
    EXPECT_GT(scenes, 10u);
}

TEST(PerLamp, LeavesTheLightmapAsItIs)
{
    const Workplace place;
    const std::string scene = box_with_bulbs(place, 3);
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("plain"), {"--sky", "1,2,3"})).code, 0);
    ASSERT_EQ(
        run_lumel(lamps_bake_of(scene, place.path("lamps"), {"--sky", "1,2,3", "--per-lamp"})).code,
        0);
    EXPECT_EQ(read_exr(place.path("plain/lightmap.exr")).values,
              read_exr(place.path("lamps/lightmap.exr")).values);
    const Json lamps = lamps_in(place.path("lamps"))["lamps"];
    ASSERT_EQ(lamps.size(), 5u);
    EXPECT_EQ(lamps[0]["kind"], "sky");
    for (const Json& lamp : lamps) {
        EXPECT_GT(lamp["error"].get<double>(), 0.0) << lamp;
        EXPECT_LT(lamp["error"].get<double>(), 0.5) << lamp;
    }
    const Json report = Json::parse(bytes_of(place.path("lamps/report.json")));
    EXPECT_NE(std::ranges::find(report["files"], "lamp-bulb_1.exr"), report["files"].end());
}

TEST(PerLamp, WorksOnPagesWithBothSidesAndDirections)
{
    const Workplace place;
    const Outcome outcome = run_lumel(
        lamps_bake_of(box_with_bulbs(place, 2), place.path("out"),
                      {"--per-lamp", "--pages", "2", "--sides", "both", "--directional", "sh1"}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    for (const char* page : {"-0", "-1"}) {
        EXPECT_GE(error_of_sum(place.path("out"), page), 0.0);
        EXPECT_LT(error_of_sum(place.path("out"), page), 1e-5);
    }
}

/// Names may hold any characters; files and groups have their own.
TEST(PerLamp, NamesFilesAndGroupsByLamps)
{
    const Workplace place;
    EditedScene box("cornell-box.gltf");
    Json& json = box.json();
    json["extensionsUsed"].push_back("KHR_lights_punctual");
    json["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "Küche / <1>"}, {"intensity", 0.1}},
        {{"type", "spot"}, {"name", "Küche : <1>"}, {"intensity", 0.1}, {"spot", Json::object()}},
        {{"type", "directional"}, {"name", "../sun"}, {"intensity", 1}}};
    for (int k = 0; k < 3; ++k)
        json["scenes"][0]["nodes"].push_back(
            box.push("nodes", {{"translation", {0.3, 0.3, 0.1}},
                               {"extensions", {{"KHR_lights_punctual", {{"light", k}}}}}}));
    const std::string scene = box.write(place);
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"), {"--per-lamp"})).code, 0);
    const Json lamps = lamps_in(place.path("out"))["lamps"];
    ASSERT_EQ(lamps.size(), 4u);
    for (const Json& lamp : lamps) {
        const std::string map = lamp["map"].get<std::string>();
        EXPECT_EQ(map.find('/'), std::string::npos);
        EXPECT_TRUE(fs::exists(place.path("out/" + map))) << map;
    }
    EXPECT_EQ(lamps[0]["kind"], "point");
    EXPECT_EQ(lamps[1]["kind"], "spot");
    EXPECT_EQ(lamps[2]["kind"], "sun");
    EXPECT_NE(lamps[0]["map"], lamps[1]["map"]);

    ASSERT_EQ(
        run_lumel(lamps_bake_of(scene, place.path("out"), {"--group", "kitchen=Küche*"})).code, 0);
    const Json joined = lamps_in(place.path("out"))["lamps"];
    ASSERT_EQ(joined.size(), 3u);
    EXPECT_EQ(joined[0]["name"], "kitchen");
    EXPECT_EQ(joined[0]["members"],
              lamps[0]["members"].size() == 1 ? Json({"Küche / <1>", "Küche : <1>"}) : Json());
    EXPECT_FALSE(fs::exists(place.path("out/" + lamps[0]["map"].get<std::string>())));
    EXPECT_LT(error_of_sum(place.path("out")), 1e-5);

    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"))).code, 0);
    EXPECT_FALSE(fs::exists(place.path("out/lamps.json")));
    EXPECT_FALSE(fs::exists(place.path("out/lamp-kitchen.exr")));
}

TEST(PerLamp, OfAnUpdateAreGoneAsTheyWouldNotFit)
{
    const Workplace place;
    const std::string scene = box_with_bulbs(place, 2);
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"), {"--per-lamp"})).code, 0);
    EditedScene moved("cornell-box.gltf");
    moved.add_block("block", {0.05f, 0.001f, 0.05f}, {0.1f, 0.1f, 0.1f});
    const Workplace other;
    const Outcome outcome =
        run_lumel({"update", place.path("out"), moved.write(other), "--preview-width", "0", "-q"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(fs::exists(place.path("out/lamps.json")));
    EXPECT_FALSE(fs::exists(place.path("out/lamp-bulb_0.exr")));
}

/// Only files that an earlier bake has listed are removed.
TEST(PerLamp, FilesOfTheUserStay)
{
    const Workplace place;
    const std::string scene = box_with_bulbs(place, 1);
    fs::create_directory(place.path("out"));
    place.file("out/lamps.json", "not json: my lamps");
    place.file("out/lamp-0.exr", "mine");
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"))).code, 0);
    EXPECT_EQ(bytes_of(place.path("out/lamps.json")), "not json: my lamps");
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"), {"--per-lamp"})).code, 0);
    ASSERT_EQ(run_lumel(lamps_bake_of(scene, place.path("out"))).code, 0);
    EXPECT_FALSE(fs::exists(place.path("out/lamps.json")));
    EXPECT_EQ(bytes_of(place.path("out/lamp-0.exr")), "mine");
}

TEST(PerLamp, OfHalfPrecisionStateNoSum)
{
    const Workplace place;
    const Outcome outcome = run_lumel(
        lamps_bake_of(own_scene("room.gltf"), place.path("out"), {"--per-lamp", "--half"}));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_FALSE(lamps_in(place.path("out")).contains("sum_error"));
    constexpr double kLeastNormalHalf = 0x1p-14;  // below, halves have fewer bits
    EXPECT_LT(error_of_sum(place.path("out"), "", kLeastNormalHalf), 2e-3);
}

TEST(PerLamp, RefusesWhatItCannotKeepApart)
{
    const Workplace place;
    const std::string scene = box_with_bulbs(place, 65);
    const auto bake = [&](const std::vector<std::string>& more) {
        return run_lumel(lamps_bake_of(scene, place.path("out"), more));
    };
    expect_one_sentence(bake({"--per-lamp"}), 2, {"64", "66", "--group"});
    expect_one_sentence(bake({"--group", "a=nothing*"}), 2, {"a=nothing*", "fits no lamp"});
    expect_one_sentence(bake({"--group", "a=bulb*", "--group", "b=bulb 7"}), 2,
                        {"\"bulb 7\"", "\"a\"", "\"b\""});
    expect_one_sentence(bake({"--group", "bulbs"}), 2, {"NAME=PATTERN"});
    expect_one_sentence(
        run_lumel({"bake", scene, place.path("out"), "--per-lamp", "--solver", "stochastic"}), 2,
        {"--per-lamp", "links"});
    EXPECT_FALSE(fs::exists(place.path("out/report.json")));
    EXPECT_EQ(bake({"--group", "bulbs=bulb*"}).code, 0);
}

/// The peak is within what the plan counts.
TEST(PerLamp, KeepsToTheMemoryAllowed)
{
    const Workplace place;
    const std::string scene = box_with_bulbs(place, 40);
    const auto bake = [&](const std::string& size, const std::string& memory) {
        return run_lumel({"bake", scene, place.path("out"), "--size", size, "--per-lamp", "--shots",
                          "24", "--preview-width", "0", "-q", "--max-memory", memory});
    };
    expect_one_sentence(bake("512", "400M"), 3, {"--max-memory allows 400.0 MiB", "--size"});
    // Many rays end near their lumel.
    const auto rays = [&](const char* memory) {
        return run_lumel({"bake", own_scene("city.gltf"), place.path("city"), "--size", "96",
                          "--sky", "1,1,1", "--links", "3072", "--per-lamp", "--preview-width", "0",
                          "-q", "--max-memory", memory});
    };
    expect_one_sentence(rays("280M"), 3, {"--max-memory allows 280.0 MiB"});
    const Outcome done = bake("160", "400M");
    ASSERT_EQ(done.code, 0) << done.err;
    const Json report = Json::parse(bytes_of(place.path("out/report.json")));
    EXPECT_LE(report["memory"]["peak_host_bytes"].get<double>(), 400.0 * 1024.0 * 1024.0);
}

}  // namespace
}  // namespace lumel::test
