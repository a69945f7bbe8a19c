// Probes, directional maps, lit files and messages of bakes in memory.

#include <algorithm>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "base/images/image_files.h"
#include "base/json/json_file.h"
#include "boxes.h"
#include "jobs/bake/bake.h"
#include "jobs/bake/lamp_maps.h"
#include "scene/gltf/document.h"

namespace lumel::v0 {
namespace {

using namespace test;

constexpr double kOne = 0.01;  ///< of a closed form

/// A closed box that glows by itself: everywhere the radiance is E / (π (1 − ρ)).
constexpr float kReflected = 0.5f, kEmitted = 100.0f;
constexpr double kRadiance = double(kEmitted) / (1.0 - double(kReflected));

SceneContent furnace()
{
    return closed_cube({.name = "glow",
                        .base_color = {kReflected, kReflected, kReflected, 1.0f},
                        .emitted = {kEmitted, kEmitted, kEmitted}});
}

Baked baked_furnace()
{
    return bake(Scene(furnace()), {.atlas = {.size = kSize}});
}

TEST(BakeWithoutDevice, IsThatOnAProcessorsDevice)
{
    const Scene scene = Scene::load(scene_path("cornell-box"));
    const BakeSettings settings{.atlas = {.size = kSize}};
    const Baked without = bake(scene, settings);
    EXPECT_EQ(
        bake(Device(), scene, {.atlas = {.size = kSize}, .options = {{"rays", "host"}}}).map.rgba,
        without.map.rgba);
    EXPECT_NE(without.solution, nullptr);
}

TEST(BakeWithoutDevice, RefusesWhatNeedsOne)
{
    const Scene scene(furnace());
    expect_error(ErrorKind::input, {"BakeSettings::method", "stochastic", "Device"},
                 [&] { bake(scene, {.method = "stochastic"}); });
    expect_error(ErrorKind::input, {"BakeSettings::directional", "Device"},
                 [&] { bake(scene, {.directional = Directional::sh1}); });
    expect_error(ErrorKind::input, {"BakeSettings::options[\"rays\"]", "Device"}, [&] {
        bake(scene, {.options = {{"rays", "query"}}});
    });
}

TEST(LampsOfABake, AddUpToItsMap)
{
    const Scene scene = Scene::load(scene_path("room"));
    const BakeSettings plain{.atlas = {.size = 128}, .shots = 24};
    BakeSettings apart = plain;
    apart.per_lamp = true;
    const Baked baked = bake(scene, apart);
    EXPECT_EQ(baked.map.rgba, bake(scene, plain).map.rgba);
    ASSERT_EQ(baked.lamps.size(), 2u);
    EXPECT_EQ(baked.lamps[0].name, "window");
    EXPECT_EQ(baked.lamps[0].kind, "surface");
    EXPECT_GT(baked.lamps[0].error, 0.0);
    for (std::size_t v = 0; v < baked.map.rgba.size(); ++v) {
        if (v % 4 == 3)
            continue;
        const float whole = baked.map.rgba[v];
        ASSERT_NEAR(baked.lamps[0].map.rgba[v] + baked.lamps[1].map.rgba[v], whole,
                    1e-5f * whole + 1e-6f);
    }
    const lumel::test::TemporaryFolder folder;
    write_scene(folder / "scene.glb", baked);
    const Json lamps =
        load_gltf_document(folder / "scene.glb").json["asset"]["extras"]["lumel"]["lamps"]["list"];
    ASSERT_EQ(lamps.size(), 2u);
    EXPECT_EQ(lamps[0]["name"], "window");
    EXPECT_EQ(lamps[1]["error"], baked.lamps[1].error);

    // Their colours are those of lumel bake --per-lamp.
    BakeOptions options{.preview_width = 0};
    options.atlas.size = 128;
    options.solver.max_shots = 24;
    options.solver.target_error = 0.0;
    set_per_lamp(options, true, {});
    lumel::bake(scene_path("room"), folder / "out", options);
    const Json written = read_json(folder / "out/lamps.json")["lamps"];
    for (std::size_t k = 0; k < lamps.size(); ++k) {
        EXPECT_EQ(lamps[k]["color"], Json(baked.lamps[k].color));
        EXPECT_EQ(lamps[k]["color"], written[k]["color"]);
    }
    EXPECT_NE(lamps[0]["color"], lamps[1]["color"]);

    apart.groups = {{"both", "*"}};
    const Baked joined = bake(scene, apart);
    ASSERT_EQ(joined.lamps.size(), 1u);
    EXPECT_EQ(joined.lamps[0].members.size(), 2u);
}

TEST(LampsOfABake, ThatCannotBeKeptApartAreRefused)
{
    const Scene scene = Scene::load(scene_path("room"));
    expect_error(ErrorKind::input, {"BakeSettings::per_lamp", "method"},
                 [&] { bake(Device(), scene, {.method = "stochastic", .per_lamp = true}); });
    expect_error(ErrorKind::input, {"BakeSettings::groups", "nobody"}, [&] {
        bake(scene, {.groups = {{"a", "nobody"}}});
    });
}

TEST(Directions, OfABakeGiveItsIrradianceAlongItsNormals)
{
    const SceneContent content = furnace();
    const Baked baked =
        bake(Device(), Scene(content), {.atlas = {.size = kSize}, .directional = Directional::sh1});
    ASSERT_EQ(baked.directional.size(), 4u);
    // A_l Y_lm of bands 0 and 1, [RH01].
    const double even = std::numbers::pi * 0.282095,
                 along = 2.0 * std::numbers::pi / 3.0 * 0.488603;
    const Surface& surface = baked.surfaces.front();
    for (const LitTriangle& one :
         lit_triangles(surface, content.meshes[0].primitives[0], baked.map)) {
        double found = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const auto at =
                lit_triangles(surface, content.meshes[0].primitives[0], baked.directional[i]);
            const auto same = std::ranges::find(at, one.centre, &LitTriangle::centre);
            const std::array<double, 4> factors{even, along * double(one.normal[1]),
                                                along * double(one.normal[2]),
                                                along * double(one.normal[0])};
            // Normals of triangles with legs of 2 m have a length of 4.
            found += same->light * (i == 0 ? factors[0] : factors[i] / 4.0);
        }
        EXPECT_NEAR(found, one.light, kOne * one.light);
    }
    expect_error(ErrorKind::input, {"BakeSettings::directional", "BakeSettings::parts"}, [&] {
        bake(Device(), Scene(content), {.parts = Parts::direct, .directional = Directional::sh1});
    });
}

TEST(Probes, InAFurnaceHaveItsRadianceInBandZeroAlone)
{
    const Baked baked = baked_furnace();
    // Y_00 over the sphere: √(4π) L.
    const double band = std::sqrt(4.0 * std::numbers::pi) * kRadiance;
    for (const Probe& probe : probes(baked, {{0, 0, 0}, {0.5f, -0.4f, 0.3f}})) {
        EXPECT_FALSE(probe.inside);
        EXPECT_NEAR(probe.coefficients[0][1], band, kOne * band);
        for (std::size_t i = 1; i < probe.coefficients.size(); ++i)
            EXPECT_NEAR(probe.coefficients[i][1], 0.0, kOne * band) << i;
    }
    EXPECT_TRUE(probes(baked, {}).empty());
}

TEST(Probes, NeedASolutionOfAllLight)
{
    Baked baked = baked_furnace();
    const float far = std::numeric_limits<float>::infinity();
    expect_error(ErrorKind::input, {"places[1]"}, [&] { probes(baked, {{0, 0, 0}, {far, 0, 0}}); });
    expect_error(ErrorKind::input, {"samples"}, [&] { probes(baked, {{0, 0, 0}}, 0); });
    baked.solution.reset();
    expect_error(ErrorKind::input, {"Baked", "solution"}, [&] { probes(baked, {}); });
    const Baked direct = bake(Scene(furnace()), {.atlas = {.size = kSize}, .parts = Parts::direct});
    expect_error(ErrorKind::input, {"Parts::all"}, [&] { probes(direct, {{0, 0, 0}}); });
}

/// A cube with a texture, two materials and a lamp, placed twice.
SceneContent furnished()
{
    SceneContent content = furnace();
    content.textures = {{.width = 2, .height = 1, .rgba = {255, 0, 0, 255, 0, 255, 0, 255}}};
    content.materials.push_back(
        {.name = "painted", .base_color = {0.5f, 0.5f, 0.5f, 1}, .base_color_texture = 0});
    Primitive& primitive = content.meshes[0].primitives[0];
    primitive.texcoords.resize(primitive.positions.size(), {0.25f, 0.5f});
    Primitive upper = primitive;
    primitive.indices.resize(18);
    upper.indices.erase(upper.indices.begin(), upper.indices.begin() + 18);
    upper.material = 1;
    content.meshes[0].primitives.push_back(upper);
    content.instances.push_back({.name = "second"});
    content.instances[1].transform[12] = 5.0f;
    content.lights = {{.name = "bulb", .intensity = 10.0f, .radius = 0.05f}};
    return content;
}

TEST(LitFiles, OfScenesInMemoryHaveAllOfThem)
{
    const lumel::test::TemporaryFolder folder;
    const SceneContent content = furnished();
    const Baked baked = bake(Scene(content), {.atlas = {.size = 2 * kSize}});
    const std::string path = folder / "scene.glb";
    write_scene(path, baked);
    const lumel::Scene read = read_gltf(path);
    ASSERT_EQ(read.instances.size(), 2u);
    EXPECT_EQ(read.instances[1].name, "second");
    EXPECT_EQ(read.instances[1].transform[3].x, 5.0f);
    ASSERT_EQ(read.lights.size(), 1u);
    EXPECT_EQ(read.lights[0].name, "bulb");
    EXPECT_EQ(read.lights[0].radius, 0.05f);
    EXPECT_EQ(read.cameras.size(), 1u);
    ASSERT_EQ(read.textures.size(), 1u);
    EXPECT_EQ(read.textures[0].rgba, content.textures[0].rgba);
    const lumel::Mesh& mesh = read.meshes[std::size_t(read.instances[1].mesh)];
    ASSERT_EQ(mesh.primitives.size(), 2u);
    const lumel::Material& glow = read.materials[std::size_t(mesh.primitives[0].material)];
    EXPECT_EQ(glow.name, "glow");
    EXPECT_EQ(glow.emitted.g, kEmitted);
    EXPECT_EQ(glow.base_color.g, kReflected);
    EXPECT_GE(read.materials[std::size_t(mesh.primitives[1].material)].base_color_texture.texture,
              0);
    // The same room lights the same.
    const Baked again = bake(Scene::load(path), {.atlas = {.size = 2 * kSize}});
    EXPECT_NEAR(mean_of(again.map), mean_of(baked.map), kOne * mean_of(baked.map));
    const GltfDocument document = load_gltf_document(path);
    for (const Json& material : document.json["materials"]) {
        const Json& lightmap = material["extensions"]["MOZ_lightmap"];
        EXPECT_LT(lightmap.value("index", 99), document.json["textures"].size());
        EXPECT_GE(double(lightmap.value("intensity", 0.0f)), 0.5 * mean_of(baked.map));
    }
}

TEST(LitFiles, OfFilesAreThoseOfTheProgram)
{
    const lumel::test::TemporaryFolder folder;
    BakeOptions options;
    options.atlas.size = kSize;
    options.solver.max_shots = 12;
    options.solver.target_error = 0.0;
    options.preview_width = 0;
    lumel::bake(scene_path("cornell-box"), folder / "baked", options);
    const Baked baked =
        bake(Scene::load(scene_path("cornell-box")), {.atlas = {.size = kSize}, .shots = 12});
    write_baked_scene(folder / "mine.glb", baked);
    EXPECT_EQ(bytes_of(folder / "mine.glb"), bytes_of(folder / "baked/scene-baked.glb"));
    write_scene(folder / "scene.glb", baked);
    EXPECT_EQ(bytes_of(folder / "scene.glb"), bytes_of(folder / "baked/scene.glb"));
}

TEST(LitFiles, AreOfTheFileAsItWasRead)
{
    const lumel::test::TemporaryFolder folder;
    const std::string path = folder / "box.gltf";
    std::filesystem::copy_file(scene_path("cornell-box"), path);
    const Baked baked = bake(Scene::load(path), {.atlas = {.size = kSize}, .shots = 12});
    write_scene(folder / "first.glb", baked);
    std::filesystem::remove(path);
    write_scene(folder / "second.glb", baked);
    EXPECT_EQ(bytes_of(folder / "first.glb"), bytes_of(folder / "second.glb"));
}

/// Far from 0, floats are coarse: the room is the same as at 0, and as its file's.
TEST(LitFiles, OfScenesFarAwayAreThere)
{
    const lumel::test::TemporaryFolder folder;
    constexpr float kFar = 30'000.0f;
    SceneContent content = furnished();
    const double near = mean_of(bake(Scene(content), {.atlas = {.size = 2 * kSize}}).map);
    for (Instance& instance : content.instances) {
        instance.transform[12] += kFar;
        instance.transform[14] += 2.0f * kFar;
    }
    content.lights[0].position = {kFar, 0.0f, 2.0f * kFar};
    const Scene far(content);
    EXPECT_EQ(far.instances()[1].transform[12], kFar + 5.0f);
    const Baked baked = bake(far, {.atlas = {.size = 2 * kSize}});
    EXPECT_NEAR(mean_of(baked.map), near, kOne * near);
    write_scene(folder / "far.glb", baked);
    const Scene read = Scene::load(folder / "far.glb");
    EXPECT_EQ(read.instances()[1].transform[12], kFar + 5.0f);
    EXPECT_NEAR(mean_of(bake(read, {.atlas = {.size = 2 * kSize}}).map), near, kOne * near);
}

TEST(LitFiles, OfScenesInMemoryAreValid)
{
    const lumel::test::TemporaryFolder folder;
    SceneContent content = furnished();
    content.materials[0].name = "caf\xe9";
    content.lights = {{.kind = Light::Kind::spot,
                       .name = "spot",
                       .color = {4.0f, 2.0f, 1.0f},
                       .intensity = 5.0f,
                       .inner_cone = 1.5707963f,
                       .outer_cone = 1.5707963f}};
    const Baked baked = bake(Scene(content), {.atlas = {.size = 2 * kSize}, .shots = 12});
    write_scene(folder / "scene.glb", baked);
    const lumel::Scene read = read_gltf(folder / "scene.glb");
    EXPECT_EQ(read.lights[0].color.r, 1.0f);
    EXPECT_EQ(read.lights[0].intensity, 20.0f);
    EXPECT_NEAR(read.lights[0].outer_cone, 1.5707963f, 1e-6f);
    EXPECT_LT(read.lights[0].inner_cone, read.lights[0].outer_cone);
    EXPECT_EQ(read.materials[0].name, "caf\uFFFD");
}

TEST(LitFiles, NeedTheirSolutionAndAPlace)
{
    Baked baked = baked_furnace();
    const lumel::test::TemporaryFolder folder;
    expect_error(ErrorKind::output, {}, [&] { write_scene(folder / "no/such/scene.glb", baked); });
    expect_error(ErrorKind::input, {"size"},
                 [&] { write_baked_scene(folder / "a.glb", baked, 0); });
    Baked cut = baked;
    cut.map.rgba.clear();
    expect_error(ErrorKind::input, {"Baked::map", "32"},
                 [&] { write_scene(folder / "a.glb", cut); });
    baked.solution.reset();
    expect_error(ErrorKind::input, {"solution"}, [&] { write_scene(folder / "a.glb", baked); });
}

TEST(Warnings, TellOfScenesWithoutLight)
{
    const Baked baked = bake(Scene(closed_cube({})), {.atlas = {.size = kSize}});
    ASSERT_FALSE(baked.notes.empty());
    EXPECT_NE(baked.notes[0].find("nothing in the scene gives light"), std::string::npos);
}

TEST(Warnings, NameFieldsOfDaylightWithoutEffect)
{
    Scene scene(furnace());
    scene.add_daylight({.sky_scale = 2.0f, .rotation = 1.0});
    const std::vector<std::string> warnings = scene.warnings();
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_TRUE(warnings[0].starts_with("Daylight::rotation has no effect")) << warnings[0];
    EXPECT_TRUE(warnings[1].starts_with("Daylight::sky_scale has no effect")) << warnings[1];
}

TEST(Warnings, ReachOneFunction)
{
    std::vector<std::string> heard;
    on_warning([&](const std::string& sentence) { heard.push_back(sentence); });
    SceneContent content = furnace();
    content.materials[0].base_color = {1, 1, 1, 1};
    const Scene scene(content);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard, scene.warnings());
    EXPECT_EQ(heard[0].find("--"), std::string::npos) << heard[0];
    heard.clear();
    const Baked baked = bake(
        scene, {.atlas = {.size = kSize}, .eye_error = 1e-6, .visible_noise = 1.0, .shots = 6});
    ASSERT_EQ(baked.notes.size(), 2u);
    EXPECT_EQ(baked.notes[0], scene.warnings()[0]);
    EXPECT_EQ(heard, std::vector<std::string>{baked.notes[1]});
    on_warning({});
    heard.clear();
    const Scene silent(content);
    EXPECT_TRUE(heard.empty());
}

}  // namespace
}  // namespace lumel::v0
