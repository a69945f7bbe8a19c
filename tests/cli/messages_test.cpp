// What the program says where a result is not what one may take it for, and what can be done.

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/images/image_files.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

std::vector<std::string> tiny_bake_of(const std::string& scene, const std::string& folder,
                                      const std::vector<std::string>& more)
{
    std::vector<std::string> arguments = {"bake", scene, folder, "--size", "32", "--preview-width",
                                          "0"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

std::vector<std::string> tiny_bake(const std::string& folder, const std::vector<std::string>& more)
{
    return tiny_bake_of(own_scene("cornell-box.gltf"), folder, more);
}

Json report_in(const Workplace& place)
{
    return Json::parse(bytes_of(place.path("out/report.json")), nullptr, false);
}

TEST(Messages, AnErrorThatIsNotReachedIsAWarning)
{
    const Workplace place;
    const Outcome bake = run_lumel(tiny_bake(place.path("out"), {"--shots", "6", "--error", "1"}));
    EXPECT_EQ(bake.code, 0) << bake.err;
    EXPECT_TRUE(has(bake.err, "warning: the estimated error is ")) << bake.err;
    EXPECT_TRUE(has(bake.err, "not the 1 % asked for")) << bake.err;
    EXPECT_TRUE(has(report_in(place)["warnings"].dump(), "not the 1 % asked for"));
    // Shots alone are no promise of an error.
    EXPECT_EQ(run_lumel(tiny_bake(place.path("out"), {"--shots", "6"})).err, "");
}

/// Visible noise; 0 if no chart is large enough to tell.
double seen_in(const Json& solution)
{
    return solution.contains("visible_noise")
               ? solution["visible_noise"]["worst_chart"].get<double>()
               : 0.0;
}

TEST(Messages, AFinerQualityTakesMoreRaysAndSaysHowGoodTheLightIs)
{
    const Workplace place;
    const auto rays = [&](const std::string& quality, double visible) {
        const Outcome bake = run_lumel(
            tiny_bake_of(own_scene("two-rooms.gltf"), place.path("out"), {"--quality", quality}));
        EXPECT_EQ(bake.code, 0) << bake.err;
        EXPECT_TRUE(has(bake.err + bake.out, "of the light around")) << bake.err << bake.out;
        const Json solution = report_in(place)["solution"];
        EXPECT_LE(seen_in(solution), visible) << quality;
        EXPECT_LE(solution["estimated_eye_error"].get<double>(), 10.0 * visible) << quality;
        return solution["shots"].get<int>();
    };
    const int draft = rays("draft", 0.01), good = rays("good", 0.005), fine = rays("fine", 0.002);
    EXPECT_LE(draft, good);
    EXPECT_LT(2 * good, fine);
}

TEST(Messages, ABakeThatEndsByDefaultSaysHowToGoOnAndWhere)
{
    const Workplace place;
    const Outcome bake = run_lumel({"bake", own_scene("room.gltf"), place.path("out"), "--size",
                                    "192", "--preview-width", "0"});
    EXPECT_EQ(bake.code, 0) << bake.err;
    const Json solution = report_in(place)["solution"];
    const double seen = seen_in(solution);
    EXPECT_EQ(has(bake.err + bake.out, "--quality good goes on"),
              solution["estimated_eye_error"].get<double>() > 0.05 || seen > 0.005);
    EXPECT_EQ(has(bake.err + bake.out, "noise may still be seen on \""), seen > 0.005);
    EXPECT_LE(solution["shots"].get<int>(), 96);
}

TEST(Messages, ATimeThatIsOverAtOnceStillLeavesLight)
{
    const Workplace place;
    const Outcome bake = run_lumel(tiny_bake(place.path("out"), {"--time", "0.001"}));
    ASSERT_EQ(bake.code, 0) << bake.err;
    EXPECT_GT(report_in(place)["solution"]["shots"], 0);
    EXPECT_TRUE(has(bake.err, "0.001 s was too short: all lumels had their first light after"))
        << bake.err;
    const Image map = read_exr(place.path("out/lightmap.exr"));
    EXPECT_GT(*std::max_element(map.values.begin(), map.values.end()), 1.0f);
}

TEST(Messages, ASceneWithoutLightIsAWarningAndHasNoError)
{
    const Workplace place;
    Json scene = Json::parse(bytes_of(own_scene("cornell-box.gltf")));
    for (Json& material : scene["materials"])
        material.erase("emissiveFactor");
    const std::string dark = place.file("dark.gltf", scene.dump());
    const Outcome bake = run_lumel(tiny_bake_of(dark, place.path("out"), {"--shots", "16"}));
    EXPECT_EQ(bake.code, 0) << bake.err;
    EXPECT_TRUE(has(bake.err, "warning: nothing in the scene gives light")) << bake.err;
    EXPECT_TRUE(has(bake.err, "--sky")) << bake.err;
    EXPECT_EQ(std::count(bake.err.begin(), bake.err.end(), '\n'), 1) << bake.err;
    EXPECT_FALSE(has(bake.out, "error")) << bake.out;
    EXPECT_FALSE(report_in(place)["solution"].contains("estimated_error"));
    EXPECT_TRUE(has(run_lumel({"info", dark, "--size", "32"}).out, "gives light"));
    const Outcome lit = run_lumel({"info", dark, "--size", "32", "--sun", "180,40"});
    EXPECT_FALSE(has(lit.out, "gives light")) << lit.out;
}

TEST(Messages, WhatHalfPrecisionClipsIsCounted)
{
    const Workplace place;
    const std::vector<std::string> sky = {"--shots", "6", "--sky", "30000,30000,30000"};
    ASSERT_EQ(run_lumel(tiny_bake(place.path("out"), sky)).code, 0);
    const Image map = read_exr(place.path("out/lightmap.exr"));
    std::size_t clipped = 0, covered = 0;
    float most = 0.0f;
    for (std::size_t i = 0; i < map.values.size(); i += 4) {
        const float brightest = *std::max_element(&map.values[i], &map.values[i] + 3);
        covered += map.values[i + 3] > 0.0f;
        if (map.values[i + 3] > 0.0f && brightest > 65504.0f) {
            ++clipped;
            most = std::max(most, brightest);
        }
    }
    ASSERT_GT(clipped, 0u);
    ASSERT_LT(clipped, covered);
    std::vector<std::string> half = sky;
    half.emplace_back("--half");
    const Outcome bake = run_lumel(tiny_bake(place.path("out"), half));
    EXPECT_TRUE(has(bake.err, fmt::format("warning: {} lumels of lightmap.exr", clipped)))
        << clipped << "\n"
        << bake.err;
    EXPECT_TRUE(has(bake.err, fmt::format("up to {:.6g} lx", most))) << most << "\n" << bake.err;
}

TEST(Messages, TheDensityThatTexturesLoseInTheBakedSceneIsSaid)
{
    const Workplace place;
    const Outcome bake =
        run_lumel({"bake", own_scene("room.gltf"), place.path("out"), "--size", "96", "--shots",
                   "3", "--preview-width", "0", "--baked-size", "96"});
    ASSERT_EQ(bake.code, 0) << bake.err;
    EXPECT_TRUE(has(bake.err, "textures in scene-baked.glb are downsampled to ")) << bake.err;
    EXPECT_TRUE(has(report_in(place)["notes"].dump(), " %; raise --baked-size, or use scene.glb"));
    // Where there are none, nothing is lost.
    EXPECT_EQ(run_lumel(tiny_bake(place.path("out"), {"--shots", "6"})).err, "");
}

TEST(Messages, HaveColoursOnTerminalsUnlessNotWanted)
{
    const Workplace place;
    const std::vector<std::string> bake =
        tiny_bake(place.path("out"), {"--shots", "6", "--error", "1", "--progress", "none"});
    const auto colours = [&](bool terminal, const std::string& setting) {
        const Outcome outcome =
            run_lumel(bake, {.terminal = terminal, .environment = {"TERM=xterm", setting}});
        EXPECT_TRUE(has(outcome.err, "warning")) << outcome.err;
        return has(outcome.err, "\033[3");
    };
    EXPECT_TRUE(colours(true, "NO_COLOR="));
    EXPECT_FALSE(colours(true, "NO_COLOR=1"));
    EXPECT_FALSE(colours(false, "NO_COLOR="));
}

TEST(Messages, ADeviceThatIsNotThereNamesThoseThatAre)
{
    const Workplace place;
    const Outcome bake = run_lumel(tiny_bake(place.path("out"), {"--device", "77"}));
    expect_one_sentence(bake, 3, {"--device 77", "no device has this number", "number 0 is "});
}

TEST(Messages, AMachineWithoutADriverIsToldWhatToInstall)
{
    const Workplace place;
    const RunOptions none{.environment = {"VK_ICD_FILENAMES=/nowhere", "VK_DRIVER_FILES=/nowhere"}};
    expect_one_sentence(run_lumel(tiny_bake(place.path("out"), {}), none), 3,
                        {"Vulkan", "mesa-vulkan-drivers"});
    expect_one_sentence(run_lumel({"devices"}, none), 3, {"Vulkan", "mesa-vulkan-drivers"});
}

TEST(Messages, AHeatMapGoesBesideTheMapThatIsMeasured)
{
    const Workplace place;
    for (const char* folder : {"a", "b"})
        ASSERT_EQ(run_lumel({"reference", own_scene("cornell-box.gltf"), place.path(folder),
                             "--spp", "1", "--size", "16"})
                      .code,
                  0);
    const Outcome compare =
        run_lumel({"compare", place.path("a/lightmap.exr"), place.path("b/lightmap.exr")});
    ASSERT_EQ(compare.code, 0) << compare.err;
    EXPECT_EQ(bytes_of(place.path("a/lightmap-vs-lightmap.png")).substr(1, 3), "PNG");
    EXPECT_FALSE(std::filesystem::exists("lightmap-vs-lightmap.png"));
}

TEST(Messages, MapsOfTwoScenesAreNotCompared)
{
    const Workplace place;
    for (const char* scene : {"cornell-box", "room"})
        ASSERT_EQ(run_lumel({"reference", own_scene(std::string(scene) + ".gltf"),
                             place.path(scene), "--spp", "1", "--size", "96"})
                      .code,
                  0);
    const std::string box = place.path("cornell-box/lightmap.exr");
    const std::string room = place.path("room/lightmap.exr");
    expect_one_sentence(run_lumel({"compare", box, room}), 2,
                        {"is of cornell-box.gltf", "is of room.gltf", "their charts differ"});
    EXPECT_FALSE(std::filesystem::exists(place.path("cornell-box/lightmap-vs-lightmap.png")));
    // Maps without a record are compared.
    const std::string alone = place.file("alone.exr", bytes_of(room));
    EXPECT_EQ(run_lumel({"compare", box, alone}).code, 0);
}

TEST(Messages, TheSunIsRecordedAsItWasGivenAndCountsAsNoLamp)
{
    const Workplace place;
    const std::string sun = "47.5,19.04,2024-06-21T14:00:00+02:00";
    ASSERT_EQ(run_lumel(tiny_bake(place.path("out"), {"--shots", "6", "--sun", sun})).code, 0);
    const Json recorded = report_in(place)["lights"]["sun"];
    EXPECT_EQ(recorded["latitude"], 47.5);
    EXPECT_EQ(recorded["longitude"], 19.04);
    EXPECT_EQ(recorded["time"], "2024-06-21T14:00:00+02:00");
    const Outcome info =
        run_lumel({"info", own_scene("cornell-box.gltf"), "--size", "32", "--sun", sun, "--json"});
    const Json facts = Json::parse(info.out, nullptr, false);
    EXPECT_EQ(facts["punctual_lights"], 0);
    EXPECT_EQ(facts["sun"], true);
}

TEST(Messages, TheReportNamesTheLibrariesThatMadeIt)
{
    const Workplace place;
    ASSERT_EQ(run_lumel(tiny_bake(place.path("out"), {"--shots", "6"})).code, 0);
    const Json libraries = report_in(place)["libraries"];
    for (const char* name : {"Draco", "Embree", "OpenEXR", "libpng", "libwebp", "meshoptimizer",
                             "nlohmann_json", "oneTBB"})
        EXPECT_TRUE(std::isdigit(libraries.value(name, "none").front())) << libraries;
}

TEST(Info, LooksAtEnoughLumelsToTellHowManyAreBuried)
{
    const auto facts = [](const char* side) {
        return Json::parse(
            run_lumel({"info", own_scene("cornell-box.gltf"), "--size", side, "--json"}).out,
            nullptr, false);
    };
    // Of 47,000 lumels it looks at all, of 740,000 at every sixth.
    const Json all = facts("256"), some = facts("1024");
    const auto share = [](const Json& json) {
        return json["buried_lumels"].get<double>() / json["lumels"].get<double>();
    };
    EXPECT_GT(some["lumels"], 700'000);
    EXPECT_NEAR(share(some), share(all), 0.01);
    EXPECT_NEAR(some["surface_area_m2"], all["surface_area_m2"], 0.01);
}

}  // namespace
}  // namespace lumel::test
