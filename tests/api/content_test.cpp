// What a host puts into a scene is checked before any work.

#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "boxes.h"

namespace lumel::v0 {
namespace {

using test::closed_cube;
using test::expect_error;
using test::scene_path;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

/// Something wrong, and the words that tell of it.
struct Wrong {
    const char* name;
    const char* place;
    const char* word;
    std::function<void(SceneContent&)> make;
};

Primitive& primitive(SceneContent& content)
{
    return content.meshes[0].primitives[0];
}

const Wrong kWrongs[] = {
    {"Index", "meshes[0].primitives[0]", "indices[3] is 24",
     [](SceneContent& c) { primitive(c).indices[3] = 24; }},
    {"HalfATriangle", "meshes[0].primitives[0]", "indices",
     [](SceneContent& c) { primitive(c).indices.pop_back(); }},
    {"Position", "meshes[0].primitives[0]", "positions[5]",
     [](SceneContent& c) { primitive(c).positions[5][1] = kNan; }},
    {"TooFewNormals", "meshes[0].primitives[0]", "normals",
     [](SceneContent& c) { primitive(c).normals.resize(3); }},
    {"TooFewTexcoords", "meshes[0].primitives[0]", "texcoords",
     [](SceneContent& c) { primitive(c).texcoords.resize(3); }},
    {"TooFewColors", "meshes[0].primitives[0]", "colors",
     [](SceneContent& c) { primitive(c).colors.resize(3); }},
    {"Material", "meshes[0].primitives[0]", "materials[1]",
     [](SceneContent& c) { primitive(c).material = 1; }},
    {"Texture", "materials[0]", "textures[0]",
     [](SceneContent& c) { c.materials[0].base_color_texture = 0; }},
    {"NegativeTexture", "materials[0]", "textures",
     [](SceneContent& c) { c.materials[0].emitted_texture = -2; }},
    {"TextureBytes", "textures[0]", "bytes",
     [](SceneContent& c) {
         c.textures = {{.width = 2, .height = 2, .rgba = {1, 2, 3}}};
     }},
    {"TextureSides", "textures[0]", "sides",
     [](SceneContent& c) { c.textures = {{.width = -1, .height = -1}}; }},
    {"Albedo", "materials[0]", "base_color",
     [](SceneContent& c) { c.materials[0].base_color[1] = 1.5f; }},
    {"Emission", "materials[0]", "emitted",
     [](SceneContent& c) { c.materials[0].emitted[2] = -1.0f; }},
    {"Mesh", "instances[0]", "meshes[7]", [](SceneContent& c) { c.instances[0].mesh = 7; }},
    {"FlatInstance", "instances[0]", "no volume",
     [](SceneContent& c) { c.instances[0].transform[0] = 0.0f; }},
    {"FarInstance", "instances[0]", "too far out",
     [](SceneContent& c) { c.instances[0].transform[12] = 2e9f; }},
    {"Transform", "instances[0]", "not finite",
     [](SceneContent& c) { c.instances[0].transform[13] = kNan; }},
    {"LightIntensity", "lights[0]", "intensity",
     [](SceneContent& c) { c.lights = {{.intensity = -1.0f}}; }},
    {"LightDirection", "lights[0]", "direction",
     [](SceneContent& c) {
         c.lights = {{.direction = {0, 0, 0}}};
     }},
    {"LightCone", "lights[0]", "cone", [](SceneContent& c) { c.lights = {{.outer_cone = 2.0f}}; }},
    {"Sky", "sky", "size",
     [](SceneContent& c) {
         c.sky = {.width = 2, .height = 2, .luminance = {{1, 1, 1}}};
     }},
    {"SkyLuminance", "sky", "luminance",
     [](SceneContent& c) {
         c.sky = {.width = 1, .height = 1, .luminance = {{-1, 1, 1}}};
     }},
};

class WrongContent : public testing::TestWithParam<Wrong> {};

TEST_P(WrongContent, IsRefusedByItsPlace)
{
    SceneContent content = closed_cube({});
    GetParam().make(content);
    expect_error(ErrorKind::input, {GetParam().place, GetParam().word},
                 [&] { Scene scene(content); });
}

INSTANTIATE_TEST_SUITE_P(Content, WrongContent, testing::ValuesIn(kWrongs),
                         [](const auto& test) { return test.param.name; });

TEST(SceneContents, AreReadBack)
{
    SceneContent content = closed_cube({});
    content.instances[0].transform[14] = 3.0f;
    content.lights = {{.kind = Light::Kind::spot, .name = "spot"}};
    Scene scene(content);
    ASSERT_EQ(scene.instances().size(), 1u);
    EXPECT_EQ(scene.instances()[0].transform, content.instances[0].transform);
    EXPECT_EQ(scene.find_instance("cube"), 0u);
    EXPECT_EQ(scene.lights(), std::vector<std::string>{"spot"});
    scene.add_daylight({.sun = Daylight::Sun{.elevation = 0.5}});
    EXPECT_EQ(scene.lights(), (std::vector<std::string>{"spot", "sun"}));
    expect_error(ErrorKind::input, {"ball"}, [&] { scene.find_instance("ball"); });
}

TEST(SceneFiles, AreRefusedByTheirName)
{
    expect_error(ErrorKind::input, {"nosuch.gltf"}, [] { Scene::load("nosuch.gltf"); });
    Scene scene = Scene::load(scene_path("cornell-box"));
    expect_error(ErrorKind::input, {"nosuch.exr"},
                 [&] { scene.add_daylight({.sky_file = "nosuch.exr"}); });
    expect_error(ErrorKind::input, {"elevation"},
                 [&] { scene.add_daylight({.sun = Daylight::Sun{.elevation = 2.0}}); });
    EXPECT_TRUE(scene.lights().empty());
}

}  // namespace
}  // namespace lumel::v0
