// An area light in all commands: its light is that of the form factor, and a bake of a bake has it
// once.

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/closed_forms.h"
#include "compared.h"
#include "edited_scene.h"
#include "program.h"

namespace lumel::test {
namespace {

using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979, kLuminance = 700.0, kHeight = 1.7;
constexpr double kAccuracy = 0.01;

/// One black floor [-2, 2]² that faces up, and a rectangle 1.2 × 0.8 above it that shines down.
std::string scene_of(const Workplace& place)
{
    EditedScene scene("cornell-box.gltf");
    Json& json = scene.json();
    json["nodes"] = Json::array();
    json["scenes"][0]["nodes"] = Json::array({0, 1});
    json["materials"] =
        Json::array({{{"pbrMetallicRoughness", {{"baseColorFactor", {0, 0, 0, 1}}}}}});
    const int positions = scene.accessor<float>({-2, 0, 2, 2, 0, 2, 2, 0, -2, -2, 0, -2}, "VEC3", 3,
                                                {{"min", {-2, 0, -2}}, {"max", {2, 0, 2}}});
    const int indices = scene.accessor<std::uint32_t>({0, 1, 2, 0, 2, 3}, "SCALAR", 1);
    const Json primitive = {
        {"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}};
    json["meshes"] = Json::array({{{"primitives", Json::array({primitive})}}});
    scene.push("nodes", {{"name", "floor"}, {"mesh", 0}});
    // -z of the light is down: a quarter turn about -x.
    scene.push("nodes", {{"name", "panel"},
                         {"translation", {0, kHeight, 0}},
                         {"rotation", {-0.70710678, 0, 0, 0.70710678}},
                         {"extensions", {{"EXT_lights_area", {{"light", 0}}}}}});
    json["extensionsUsed"] = {"EXT_lights_area"};
    json["extensions"]["EXT_lights_area"]["lights"] = Json::array({{{"type", "rect"},
                                                                    {"size", 0.8},
                                                                    {"rect", {{"aspect", 1.5}}},
                                                                    {"intensity", kLuminance}}});
    return scene.write(place);
}

/// Illuminance of the floor at x, z.
double lux_at(double x, double z)
{
    return kPi * kLuminance *
           point_to_parallel_rectangle({-0.6 - x, 0.6 - x}, {-0.4 - z, 0.4 - z}, kHeight);
}

void run(const std::vector<std::string>& arguments)
{
    const Outcome outcome = run_lumel(arguments);
    ASSERT_EQ(outcome.code, 0) << outcome.err;
}

Json measured(const std::string& folder)
{
    const Outcome outcome = run_lumel({"measure", folder, "--at", "0,0.001,0", "--at",
                                       "0.9,0.001,0.5", "--samples", "16384", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return Json::parse(outcome.out)["points"];
}

void expect_form_factor(const std::string& folder)
{
    const Json points = measured(folder);
    EXPECT_NEAR(points[0]["illuminance"].get<double>(), lux_at(0, 0), kAccuracy * lux_at(0, 0));
    EXPECT_NEAR(points[1]["illuminance"].get<double>(), lux_at(0.9, 0.5),
                kAccuracy * lux_at(0.9, 0.5));
}

}  // namespace

TEST(AreaLight, LightsByItsFormFactorOnceHoweverOftenItIsBaked)
{
    const Workplace place;
    const std::string scene = scene_of(place), out = place.path("out"), again = place.path("again");
    run({"bake", scene, out, "--size", "64", "--preview-width", "0", "-q"});
    expect_form_factor(out);

    run({"reference", scene, place.path("paths"), "--size", "64", "--spp", "256", "-q"});
    EXPECT_LT(rmse_between(out + "/lightmap.exr", place.path("paths/lightmap.exr")), 2 * kAccuracy);

    const Outcome update = run_lumel({"update", out, scene, "--preview-width", "0", "--json"});
    EXPECT_EQ(update.code, 0) << update.err;
    expect_form_factor(out);

    run({"bake", out + "/scene.glb", again, "--size", "64", "--preview-width", "0", "-q"});
    expect_form_factor(again);
}

}  // namespace lumel::test
