// A bake follows its edited scene: the corrected maps are those of a bake of the edited scene.

#include <algorithm>
#include <filesystem>
#include <functional>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compared.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

constexpr const char* kSide = "64";        // of the atlas [texels]
constexpr const char* kBakeError = "0.7";  // of the bakes that are compared [%]
constexpr double kAlike = 0.02;  // relative RMSE; that of bakes to 1 % with two seeds is 1.2 %

/// A finished bake of the Cornell box, and edits of its scene.
class Bake {
public:
    using Edit = std::function<void(Json&)>;

    /// prepare: what differs from the Cornell box in this bake and in all that follow it.
    explicit Bake(
        const std::vector<std::string>& more = {}, const Edit& prepare = [](Json&) {})
        : prepare_(prepare)
    {
        std::vector<std::string> arguments = {"bake", scene_file([](Json&) {}), folder(), "--error",
                                              kBakeError};
        append_common(arguments);
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }

    std::string folder() const { return place.path("out"); }
    std::string map() const { return place.path("out/lightmap.exr"); }

    /// The report of an update for the scene as `edit` leaves it.
    Json follow(const Edit& edit, const std::vector<std::string>& more = {}) const
    {
        return update(scene_file(edit), more);
    }

    Json update(const std::string& scene, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments = {"update",          folder(), scene,
                                              "--preview-width", "0",      "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const Json report = Json::parse(outcome.out, nullptr, false);
        EXPECT_FALSE(report.is_discarded()) << outcome.out;
        EXPECT_EQ(report, Json::parse(bytes_of(place.path("out/report.json"))));
        return report;
    }

    /// Relative RMSE between the map and that of a bake of the same scene, in the same atlas.
    double error(const Json& report, const std::vector<std::string>& more = {}) const
    {
        std::vector<std::string> arguments = {
            "bake",
            place.path("out/scene.glb"),
            place.path("fresh"),
            "--error",
            kBakeError,
            "--size",
            std::to_string(report["sizes"]["atlas_width"].get<int>()),
            "--preview-width",
            "0",
            "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_EQ(run_lumel(arguments).code, 0);
        return rmse_between(map(), place.path("fresh/lightmap.exr"));
    }

    const Workplace place;

private:
    std::string scene_file(const Edit& edit) const
    {
        Json scene = Json::parse(bytes_of(own_scene("cornell-box.gltf")));
        prepare_(scene);
        edit(scene);
        return place.file("edited.gltf", scene.dump());
    }

    Edit prepare_;

    static void append_common(std::vector<std::string>& arguments)
    {
        for (const char* word : {"--size", kSide, "--preview-width", "0", "-q"})
            arguments.emplace_back(word);
    }
};

Json& named(Json& list, const std::string& name)
{
    for (Json& entry : list)
        if (entry.value("name", "") == name)
            return entry;
    throw std::runtime_error("nothing is called " + name);
}

std::size_t number_of(const Json& list, const std::string& name)
{
    for (std::size_t i = 0; i < list.size(); ++i)
        if (list[i].value("name", "") == name)
            return i;
    throw std::runtime_error("nothing is called " + name);
}

void move_block(Json& scene)
{
    named(scene["nodes"], "short block")["translation"] = {-0.05, 0.0, 0.08};
}

TEST(Update, OfASceneThatDidNotChangeLeavesTheMapAsItIs)
{
    const Bake bake;
    const std::string before = bytes_of(bake.map());
    const Outcome outcome =
        run_lumel({"update", bake.folder(), own_scene("cornell-box.gltf"), "--preview-width", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("nothing has changed"), std::string::npos) << outcome.out;
    EXPECT_EQ(bytes_of(bake.map()), before);
    // The bake's own scene is the same one, whose vertices are split.
    const Json report =
        bake.update(bake.place.file("copy.glb", bytes_of(bake.place.path("out/scene.glb"))));
    EXPECT_EQ(report["update"]["rays"], 0);
    EXPECT_EQ(report["update"]["particles"], 0);
    EXPECT_EQ(report["update"]["residual"], 0.0);
}

TEST(Update, AMovedBlockIsLitAsIfItAlwaysStoodThere)
{
    const Bake bake;
    const std::string before = bake.place.file("before.exr", bytes_of(bake.map()));
    const Json report = bake.follow(move_block);
    EXPECT_EQ(report["update"]["moved"], 1);
    EXPECT_EQ(report["update"]["solved_anew"], false);
    EXPECT_LE(report["update"]["residual"], 0.015);
    EXPECT_GT(rmse_between(before, bake.map()), 0.1);  // it did make a difference
    EXPECT_LE(bake.error(report), kAlike);
}

TEST(Update, MovedThereAndBackIsAsBefore)
{
    const Bake bake;
    const std::string before = bake.place.file("before.exr", bytes_of(bake.map()));
    bake.follow(move_block);
    const Json report = bake.follow([](Json&) {});
    EXPECT_EQ(report["update"]["moved"], 1);
    EXPECT_LE(rmse_between(bake.map(), before), kAlike);
}

TEST(Update, AnEditOfTheBakesOwnSceneWillDo)
{
    const Bake bake, other;
    bake.follow(move_block);
    const Json again =
        other.update(other.place.file("moved.glb", bytes_of(bake.place.path("out/scene.glb"))));
    EXPECT_EQ(again["update"]["moved"], 1);
    EXPECT_LE(rmse_between(bake.map(), other.map()), 0.001);
}

void make_double_sided(Json& scene)
{
    for (Json& material : scene["materials"])
        material["doubleSided"] = true;
}

TEST(Update, KnowsTwoSidesOfAWallAsOne)
{
    const Bake bake({"--sky", "1,1,1", "--sky-directions", "64"}, make_double_sided);
    const std::string before = bake.place.file("before.exr", bytes_of(bake.map()));
    const Json same =
        bake.update(bake.place.file("copy.glb", bytes_of(bake.place.path("out/scene.glb"))));
    EXPECT_EQ(same["update"]["particles"], 0);
    const Json there = bake.follow(move_block);
    EXPECT_EQ(there["update"]["moved"], 1);
    EXPECT_EQ(there["update"]["appeared"], 0);
    EXPECT_GT(rmse_between(before, bake.map()), 0.02);
    bake.follow([](Json&) {});
    EXPECT_LE(rmse_between(bake.map(), before), kAlike);
}

TEST(Update, WhatVanishesLeavesNoShadow)
{
    const Bake bake;
    const Json report = bake.follow([](Json& scene) {
        Json& nodes = scene["scenes"][0]["nodes"];
        nodes.erase(
            std::find(nodes.begin(), nodes.end(), number_of(scene["nodes"], "short block")));
    });
    EXPECT_EQ(report["update"]["vanished"], 1);
    EXPECT_LE(bake.error(report), kAlike);
}

TEST(Update, WhatAppearsIsLitAndCastsAShadow)
{
    const Bake bake;
    const Json report = bake.follow([](Json& scene) {
        Json third = named(scene["nodes"], "tall block");
        third["name"] = "third block";
        third["translation"] = {-0.02, 0.33, -0.02};
        third["scale"] = {0.5, 0.5, 0.5};
        scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
        scene["nodes"].push_back(third);
    });
    EXPECT_EQ(report["update"]["appeared"], 1);
    EXPECT_EQ(report["update"]["moved"], 0);
    EXPECT_LE(bake.error(report), kAlike);
}

TEST(Update, APaintedWallColoursTheRoom)
{
    const Bake bake;
    const Json report = bake.follow([](Json& scene) {
        named(scene["materials"], "red")["pbrMetallicRoughness"]["baseColorFactor"] = {0.1, 0.2,
                                                                                       0.7, 1.0};
    });
    EXPECT_EQ(report["update"]["recoloured"], 1);
    EXPECT_LE(bake.error(report), kAlike);
}

TEST(Update, ABrighterLampLightsMore)
{
    const Bake bake;
    const Json report = bake.follow([](Json& scene) {
        Json& lamp = named(scene["materials"], "light");
        Json& strength = lamp["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"];
        strength = 2.0 * strength.get<double>();
    });
    EXPECT_EQ(report["update"]["recoloured"], 1);
    EXPECT_LE(bake.error(report), kAlike);
}

TEST(Update, AMovedBlockTakesItsShadowInTheSunAlong)
{
    const std::vector<std::string> sun = {"--sun", "10,35", "--sky-directions", "64"};
    const Bake bake(sun);
    const std::string before = bake.place.file("before.exr", bytes_of(bake.map()));
    const Json report = bake.follow(move_block);
    EXPECT_EQ(report["lights"]["sun"], Json({{"azimuth", 10}, {"elevation", 35}}));
    EXPECT_EQ(report["update"]["relit"], false);
    EXPECT_EQ(report["update"]["solved_anew"], false);
    EXPECT_GT(rmse_between(before, bake.map()), 0.1);
    EXPECT_LE(bake.error(report, sun), kAlike);
}

TEST(Update, AnotherSkyIsAnotherLight)
{
    const Bake bake({"--sky", "1,1,1", "--sky-directions", "64"});
    const std::vector<std::string> sky = {"--sky", "1.1,1.2,1.3"};
    const Json report = bake.follow([](Json&) {}, sky);
    EXPECT_EQ(report["lights"]["sky"]["radiance"], Json({1.1, 1.2, 1.3}));
    EXPECT_EQ(report["update"]["relit"], true);
    EXPECT_EQ(report["update"]["solved_anew"], false);
    EXPECT_LE(bake.error(report, {"--sky", "1.1,1.2,1.3", "--sky-directions", "64"}), kAlike);
}

TEST(Update, TellsOfTheSceneOnceIfItSolvesAnew)
{
    const Bake bake;
    const Outcome outcome =
        run_lumel({"update", bake.folder(), own_scene("planes.gltf"), "--preview-width", "0"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("solved anew"), std::string::npos) << outcome.out;
    for (const char* words : {"nothing in the scene gives light", "lightmap has been enlarged"}) {
        const std::size_t first = outcome.err.find(words);
        EXPECT_NE(first, std::string::npos) << words << ": " << outcome.err;
        EXPECT_EQ(outcome.err.find(words, first + 1), std::string::npos) << outcome.err;
    }
}

TEST(Update, RefusesWhatItCannotCorrect)
{
    const Workplace empty;
    expect_one_sentence(run_lumel({"update", empty.path("nowhere"), own_scene("cornell-box.gltf")}),
                        2, {"nowhere", "report.json", "bake"});
    const std::string scene = own_scene("cornell-box.gltf");
    const Bake bake({"--directional", "sh1"});
    expect_one_sentence(run_lumel({"update", bake.folder(), scene}), 2, {"directional"});
    const Bake half;
    expect_one_sentence(run_lumel({"update", half.folder(), half.place.path("out/scene.glb")}), 2,
                        {"scene.glb", "elsewhere"});
    Json report = Json::parse(bytes_of(half.place.path("out/report.json")));
    report["settings"]["gutter"] = "two";
    half.place.file("out/report.json", report.dump());
    for (const char* command : {"update", "why", "relight"}) {
        std::vector<std::string> line = {command, half.folder()};
        if (std::string(command) == "why")
            line.insert(line.end(), {"--texel", "1,1"});
        else
            line.push_back(scene);
        expect_one_sentence(run_lumel(line), 2, {"report.json: /settings/gutter", "whole number"});
    }
    std::filesystem::remove(half.place.path("out/solution.exr"));
    expect_one_sentence(run_lumel({"update", half.folder(), scene}), 2, {"solution.exr"});
    half.place.file("out/report.json", "{}");
    half.place.file("out/solution.exr", "nothing");
    expect_one_sentence(run_lumel({"update", half.folder(), scene}), 2, {"report.json"});
}

}  // namespace
}  // namespace lumel::test
