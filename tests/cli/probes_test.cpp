// lumel probes, from outside.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

void bake(const std::string& scene, const std::string& folder,
          const std::vector<std::string>& more = {})
{
    std::vector<std::string> arguments = {"bake", scene, folder, "--size", "64", "--preview-width",
                                          "0",    "-q"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_lumel(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

Json probes(const std::string& folder, std::vector<std::string> more)
{
    std::vector<std::string> arguments = {"probes", folder, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run_lumel(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out);
}

/// A scene of the project's own with one more node.
std::string scene_with(const Workplace& place, const std::string& name, const Json& node)
{
    Json scene = Json::parse(bytes_of(own_scene(name)));
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
    scene["nodes"].push_back(node);
    return place.file(name, scene.dump());
}

// 2 √π L with L = B / π and B = E / (1 - ρ), E = 1.
TEST(Probes, InAFurnaceAreTheSameEverywhereAndKnowNoDirection)
{
    const Workplace place;
    const std::string folder = place.path("out");
    bake(own_scene("furnace-0.5.gltf"), folder, {"--error", "0.2"});
    const Json file = probes(folder, {"--spacing", "0.4"});
    EXPECT_EQ(file["grid"]["counts"], Json({2, 2, 2}));
    ASSERT_EQ(file["probes"].size(), 8u);
    const double expected = 2.0 / std::sqrt(std::numbers::pi) * 2.0;
    for (const Json& probe : file["probes"]) {
        EXPECT_FALSE(probe["inside"]);
        ASSERT_EQ(probe["coefficients"].size(), 27u);
        for (std::size_t i = 0; i < 27; ++i)
            EXPECT_NEAR(probe["coefficients"][i].get<double>(), i < 3 ? expected : 0.0,
                        0.02 * expected);
    }
    EXPECT_NEAR(file["probes"][1]["position"][0].get<double>(),
                file["probes"][0]["position"][0].get<double>() + 0.4, 1e-9);
    EXPECT_EQ(Json::parse(bytes_of(folder + "/probes.json")), file);
    // The same rays each time.
    EXPECT_EQ(probes(folder, {"--spacing", "0.4"}), file);
    // They are of this bake, not of the next.
    bake(own_scene("furnace-0.5.gltf"), folder, {"--error", "0.2"});
    EXPECT_EQ(bytes_of(folder + "/probes.json"), "");
}

TEST(Probes, StandWhereNodesOfTheFileSay)
{
    const Workplace place;
    const std::string scene = scene_with(place, "cornell-box.gltf",
                                         {{"name", "sofa"},
                                          {"translation", {0.3, 0.4, 0.1}},
                                          {"extras", {{"lumel", {{"probe", true}}}}}});
    bake(scene, place.path("out"), {"--shots", "64"});
    const std::string elsewhere = place.path("mine.json");
    const Json file =
        probes(place.path("out"), {"--at", "0.186,0.08,0.168", "--output", elsewhere});
    EXPECT_FALSE(file.contains("grid"));
    ASSERT_EQ(file["probes"].size(), 2u);
    EXPECT_EQ(file["probes"][0]["name"], "sofa");
    EXPECT_NEAR(file["probes"][0]["position"][1].get<double>(), 0.4, 1e-6);
    EXPECT_GT(file["probes"][0]["coefficients"][0].get<double>(), 0.0);
    // The other is in the short block.
    EXPECT_TRUE(file["probes"][1]["inside"]);
    EXPECT_FALSE(file["probes"][1].contains("coefficients"));
    EXPECT_EQ(Json::parse(bytes_of(elsewhere)), file);
}

/// The JSON of a .glb.
Json gltf_in(const std::string& path)
{
    constexpr std::size_t kJsonLengthAt = 12, kJsonAt = 20;
    const std::string file = bytes_of(path);
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;)
        length = length << 8 | std::uint8_t(file.at(kJsonLengthAt + i));
    return Json::parse(file.substr(kJsonAt, length));
}

TEST(Probes, OfABakeAreThoseOfTheCommandByteForByte)
{
    const Workplace place;
    const std::string one = place.path("one"), two = place.path("two");
    bake(own_scene("cornell-box.gltf"), one, {"--shots", "24", "--probes", "0.15"});
    bake(own_scene("cornell-box.gltf"), two, {"--shots", "24"});
    const std::string together = bytes_of(one + "/probes.json");
    ASSERT_NE(together, "");
    probes(two, {"--spacing", "0.15"});
    EXPECT_EQ(together, bytes_of(two + "/probes.json"));
    // Nor do the nodes in the files count as places for more of them.
    probes(one, {"--spacing", "0.15"});
    EXPECT_EQ(together, bytes_of(one + "/probes.json"));
}

TEST(Probes, OfABakeAreNodesOfItsFilesUntilTheNextBake)
{
    const Workplace place;
    const std::string folder = place.path("out");
    bake(own_scene("cornell-box.gltf"), folder, {"--shots", "24", "--probes", "0.15"});
    const Json file = Json::parse(bytes_of(folder + "/probes.json"));
    std::size_t inside = 0;
    for (const char* name : {"/scene.glb", "/scene-baked.glb"}) {
        const Json gltf = gltf_in(folder + name);
        const Json& group = gltf["nodes"][gltf["scenes"][0]["nodes"].back().get<std::size_t>()];
        ASSERT_EQ(group["children"].size(), file["probes"].size());
        for (std::size_t i = 0; i < file["probes"].size(); ++i) {
            const Json& probe = file["probes"][i];
            const Json& node = gltf["nodes"][group["children"][i].get<std::size_t>()];
            const Json& light = node["extras"]["lumel"]["light_probe"];
            EXPECT_EQ(node["translation"], probe["position"]);
            EXPECT_EQ(light["inside"], probe["inside"]);
            EXPECT_EQ(light.value("coefficients", Json()), probe.value("coefficients", Json()));
            inside += probe["inside"].get<bool>();
        }
    }
    EXPECT_GT(inside, 0u);  // of the blocks
    bake(folder + "/scene.glb", place.path("again"), {"--shots", "24"});
    EXPECT_EQ(gltf_in(place.path("again/scene.glb")).dump().find("light_probe"), std::string::npos);
}

TEST(Probes, OfABakeAreRefusedBeforeTheWork)
{
    const Workplace place;
    const std::string scene = own_scene("cornell-box.gltf"), out = place.path("out");
    expect_one_sentence(run_lumel({"bake", scene, out, "--probes", "1e-5"}), 2,
                        {"--probes", "million"});
    expect_one_sentence(run_lumel({"bake", scene, out, "--probes", "0.2", "--only", "indirect"}), 2,
                        {"--probes", "--only"});
    EXPECT_FALSE(std::filesystem::exists(place.path("out")));
}

TEST(Probes, NeedAPlaceAndExtrasThatSayYesOrNo)
{
    const Workplace place;
    bake(own_scene("furnace-0.5.gltf"), place.path("out"), {"--shots", "64"});
    expect_one_sentence(run_lumel({"probes", place.path("out")}), 2, {"--spacing", "--at"});
    expect_one_sentence(run_lumel({"probes", place.path("out"), "--spacing", "1e-5"}), 2,
                        {"--spacing", "million"});
    expect_one_sentence(run_lumel({"probes", place.path("none"), "--spacing", "1"}), 2, {"none"});
    const std::string scene =
        scene_with(place, "furnace-0.5.gltf", {{"extras", {{"lumel", {{"probe", "yes"}}}}}});
    bake(scene, place.path("yes"), {"--shots", "64"});
    expect_one_sentence(run_lumel({"probes", place.path("yes")}), 2, {"extras/lumel/probe"});
}

}  // namespace
}  // namespace lumel::test
