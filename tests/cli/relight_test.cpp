// A bake is lit anew, and shows where its light comes from.

#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "compared.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

/// Relative RMSE between a state and a fresh bake of it; two bakes with other seeds are 1.5 %
/// apart.
constexpr double kLikeNew = 0.03;

/// A finished bake of the Cornell box.
class MatrixBake {
public:
    /// A copy of a bake that is made once for equal options.
    explicit MatrixBake(const std::vector<std::string>& more = {})
    {
        static std::map<std::vector<std::string>, Workplace> made;
        const auto [found, is_new] = made.try_emplace(more);
        const std::string kept = found->second.path("out");
        if (is_new)
            bake(own_scene("cornell-box.gltf"), kept, more);
        std::filesystem::copy(kept, folder(), std::filesystem::copy_options::recursive);
    }

    /// Of the Cornell box as `edit` leaves it.
    explicit MatrixBake(const std::function<void(Json&)>& edit) { fresh("out", edit); }

    std::string folder() const { return place.path("out"); }

    /// What relight prints.
    Json relight(const Json& states) const
    {
        const Outcome outcome =
            run_lumel({"relight", folder(), place.file("states.json", states.dump()), "--json"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        const Json report = Json::parse(outcome.out, nullptr, false);
        EXPECT_FALSE(report.is_discarded()) << outcome.out;
        return report;
    }

    Outcome fails(const std::string& states) const
    {
        return run_lumel({"relight", folder(), place.file("states.json", states)});
    }

    /// The Cornell box as `edit` leaves it, baked into a folder of that name.
    std::string fresh(const std::string& name, const std::function<void(Json&)>& edit,
                      const std::vector<std::string>& more = {}) const
    {
        Json scene = Json::parse(bytes_of(own_scene("cornell-box.gltf")));
        edit(scene);
        bake(place.file("edited.gltf", scene.dump()), place.path(name), more);
        return place.path(name + "/lightmap.exr");
    }

    const Workplace place;

private:
    static void bake(const std::string& scene, const std::string& folder,
                     const std::vector<std::string>& more)
    {
        std::vector<std::string> arguments = {
            "bake",      scene, folder,    "--solver", "matrix",          "--size", "48",
            "--patches", "300", "--error", "1.5",      "--preview-width", "0",      "-q"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run_lumel(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
};

const std::vector<std::string> kSky = {"--sky", "2,3,6", "--sky-directions", "256"};

TEST(Relight, WithAllFactorsOneIsTheBake)
{
    const MatrixBake bake(kSky);
    const Json report = bake.relight({{"states", {{{"name", "as baked"}}}}});
    EXPECT_EQ(report["matrix"]["sources"], Json({"sky", "light"}));
    EXPECT_EQ(report["states"][0]["files"], Json({"as baked.exr", "as baked.png"}));
    EXPECT_TRUE(std::filesystem::exists(bake.place.path("out/states/as baked.png")));
    EXPECT_LT(rmse_between(bake.place.path("out/states/as baked.exr"),
                           bake.place.path("out/lightmap.exr")),
              0.003);  // of the compressed matrix, which aims at 0.2 %
}

TEST(Relight, ByThePapersFormIsTheBakeWithinAFewPerCent)
{
    const MatrixBake bake({"--sky", "2,3,6", "--sky-directions", "256", "--form", "bc1"});
    bake.relight({{"states", {{{"name", "as baked"}}}}});
    EXPECT_LT(rmse_between(bake.place.path("out/states/as baked.exr"),
                           bake.place.path("out/lightmap.exr")),
              0.03);
    const Json report = Json::parse(bytes_of(bake.place.path("out/report.json")));
    EXPECT_EQ(report["solver"]["options"]["form"], "bc1");
}

TEST(Relight, WithALampSwitchedOffIsABakeWithoutIt)
{
    const MatrixBake bake(kSky);
    bake.relight({{"states",
                   {{{"name", "night"}, {"lights", {{"sky", 0}}}},
                    {{"name", "day"}, {"lights", {{"light", 0}}}},
                    {{"name", "dusk"}, {"others", 0}, {"lights", {{"light", {0.5, 0.2, 0.1}}}}}}}});
    const MatrixBake night;
    EXPECT_LT(
        rmse_between(bake.place.path("out/states/night.exr"), night.place.path("out/lightmap.exr")),
        kLikeNew);
    const auto lamp = [](Json& scene) -> Json& {
        for (Json& material : scene["materials"])
            if (material["name"] == "light")
                return material;
        throw std::runtime_error("there is no light");
    };
    const std::string day = bake.fresh(
        "day",
        [&](Json& scene) {
            lamp(scene)["emissiveFactor"] = {0, 0, 0};
        },
        kSky);
    EXPECT_LT(rmse_between(bake.place.path("out/states/day.exr"), day), kLikeNew);
    const std::string dusk = bake.fresh("dusk", [&](Json& scene) {
        const double factors[] = {0.5, 0.2, 0.1};
        for (int c = 0; c < 3; ++c)
            lamp(scene)["emissiveFactor"][c] =
                factors[c] * lamp(scene)["emissiveFactor"][c].get<double>();
    });
    EXPECT_LT(rmse_between(bake.place.path("out/states/dusk.exr"), dusk), kLikeNew);
}

/// Adds a lamp at a place [m].
void add_lamp(Json& scene, const std::vector<double>& place)
{
    scene["extensionsUsed"].push_back("KHR_lights_punctual");
    scene["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "point"}, {"name", "bulb"}, {"intensity", 0.1}}};
    scene["scenes"][0]["nodes"].push_back(scene["nodes"].size());
    scene["nodes"].push_back({{"name", "bulb"},
                              {"translation", place},
                              {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

// The lamp's shadow maps are drawn anew; scene.glb itself has no lamp any more.
TEST(Relight, WithALampThatMovedIsABakeWithTheLampThere)
{
    const std::vector<double> here = {0.45, 0.3, 0.1}, there = {0.12, 0.5, 0.3};
    const MatrixBake bake([&](Json& scene) { add_lamp(scene, here); });
    bake.relight(
        {{"states", {{{"name", "moved"}, {"lights", {{"bulb", {{"position", there}}}}}}}}});
    const std::string fresh = bake.fresh("there", [&](Json& scene) { add_lamp(scene, there); });
    EXPECT_LT(rmse_between(bake.place.path("out/states/moved.exr"), fresh), 0.01);
    EXPECT_GT(rmse_between(bake.place.path("out/lightmap.exr"), fresh), 0.1);
}

TEST(Relight, RefusesWhatItCannotLight)
{
    const MatrixBake bake;
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a", "lights": {"lamp": 1}}]})"), 2,
                        {"states.json", "\"a\"", "\"lamp\"", "\"light\""});
    expect_one_sentence(bake.fails(R"({"states": [{"name": "../a"}]})"), 2, {"../a", "/name"});
    expect_one_sentence(bake.fails(R"({"states": [{"name": ""}]})"), 2, {"/states/0/name"});
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a"}, {"name": "a"}]})"), 2,
                        {"second", "\"a\"", "/states/1"});
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a", "others": -1}]})"), 2,
                        {"/states/0/others"});
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a", "lights": {"light": [1, 2]}}]})"),
                        2, {"/lights/light", "[r, g, b]"});
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a", "light": 1}]})"), 2, {"\"light\""});
    expect_one_sentence(
        bake.fails(R"({"states": [{"name": "a", "lights": {"light": {"position": [1, 2, 3]}}}]})"),
        2, {"\"light\"", "not a lamp"});
    expect_one_sentence(
        bake.fails(R"({"states": [{"name": "a", "lights": {"light": {"azimuth": 10}}}]})"), 2,
        {"/lights/light", "elevation"});
    expect_one_sentence(
        bake.fails(R"({"states": [{"name": "a", "lights": {"light": {"place": [1, 2, 3]}}}]})"), 2,
        {"\"place\""});
    expect_one_sentence(bake.fails(R"({"states": []})"), 2, {"no state"});
    expect_one_sentence(bake.fails(R"({"states": [)"), 2, {"line 1"});
    EXPECT_FALSE(std::filesystem::exists(bake.place.path("out/states")));

    std::filesystem::remove(bake.place.path("out/scene.lumelmat"));
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a"}]})"), 2,
                        {"scene.lumelmat", "--solver matrix"});
}

TEST(Relight, RefusesTheMatrixOfAnotherScene)
{
    const MatrixBake bake, other(kSky);
    bake.place.file("out/scene.lumelmat", bytes_of(other.place.path("out/scene.lumelmat")));
    expect_one_sentence(bake.fails(R"({"states": [{"name": "a"}]})"), 2,
                        {"scene.lumelmat", "another scene"});
}

TEST(Why, TheFloorBesideTheRedWallIsLitByIt)
{
    const MatrixBake bake;
    // Of some texels the one of the floor that is nearest to the red wall.
    Json beside;
    double least = 1e30;
    for (int y = 1; y < 48; y += 4)
        for (int x = 1; x < 48; x += 4) {
            const Outcome outcome =
                run_lumel({"why", bake.folder(), "--texel",
                           std::to_string(x) + "," + std::to_string(y), "--json", "--width", "0"});
            if (outcome.code != 0)
                continue;
            const Json report = Json::parse(outcome.out);
            if (report["lumel"]["instance"] != "floor")
                continue;
            for (const Json& sender : report["senders"])
                if (sender.value("material", "") == "red" && sender["distance"] < least) {
                    least = sender["distance"].get<double>();
                    beside = report;
                }
        }
    ASSERT_FALSE(beside.is_null());
    double sum = 0.0;
    for (const Json& sender : beside["senders"])
        sum += sender["share"].get<double>();
    EXPECT_NEAR(sum, 1.0, 1e-6);
    EXPECT_EQ(beside["by_name"][0]["name"], "light");
    EXPECT_EQ(beside["by_name"][1]["name"], "left wall");
    EXPECT_EQ(beside["senders"][0]["material"], "light");
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(beside["lumel"]["found"][c].get<double>() /
                        beside["lumel"]["irradiance"][c].get<double>(),
                    1.0, 0.1);
}

TEST(Why, PaintsAPictureAndRefusesWhatIsNoPlace)
{
    const MatrixBake bake;
    const Outcome outcome =
        run_lumel({"why", bake.folder(), "--lumel", "0.5,0.5", "--width", "64"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("share"), std::string::npos) << outcome.out;
    EXPECT_NE(bytes_of(bake.place.path("out/why.png")), "");
    expect_one_sentence(run_lumel({"why", bake.folder()}), 2, {"--lumel"});
    expect_one_sentence(run_lumel({"why", bake.folder(), "--lumel", "2,0"}), 2, {"--lumel"});
    expect_one_sentence(run_lumel({"why", bake.folder(), "--texel", "48,0"}), 2, {"--texel", "48"});
    expect_one_sentence(run_lumel({"why", bake.folder(), "--texel", "47,47"}), 2, {"nearest"});
    std::filesystem::remove(bake.place.path("out/solution.exr"));
    expect_one_sentence(run_lumel({"why", bake.folder(), "--lumel", "0.5,0.5"}), 2,
                        {"solution.exr"});
}

TEST(Why, RefusesABakeOfAPartOfTheLight)
{
    const Workplace place;
    const std::string folder = place.path("out");
    const Outcome baked =
        run_lumel({"bake", own_scene("cornell-box.gltf"), folder, "--size", "32", "--shots", "16",
                   "--only", "indirect", "--preview-width", "0"});
    ASSERT_EQ(baked.code, 0) << baked.err;
    expect_one_sentence(run_lumel({"why", folder, "--lumel", "0.5,0.5"}), 2, {"--only"});
}

}  // namespace
}  // namespace lumel::test
