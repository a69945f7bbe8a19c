// Bakes in memory.

#include <numbers>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "bake/bake.h"
#include "boxes.h"
#include "images/image_files.h"

namespace lumel::v0 {
namespace {

using test::closed_cube;
using test::expect_error;
using test::mean_of;
using test::scene_path;

constexpr int kSize = 32;  // of the atlas [texels]
constexpr std::uint64_t kShots = 512;

TEST(Library, IsOfTheVersionOfItsHeader)
{
    EXPECT_EQ(version(), LUMEL_VERSION);
}

TEST(Library, ListsTheDeviceThatItPicks)
{
    const Device device;
    EXPECT_TRUE(device.info().usable);
    bool listed = false;
    for (const DeviceInfo& info : list_devices())
        listed = listed || info.name == device.info().name;
    EXPECT_TRUE(listed);
    expect_error(ErrorKind::device, {"no such device"}, [] { Device("no such device"); });
}

TEST(BakeInMemory, IsWhatTheProgramWrites)
{
    const lumel::test::TemporaryFolder folder;
    BakeOptions options;
    options.atlas.size = kSize;
    options.solver.max_shots = kShots;
    options.solver.target_error = 0.0;
    options.preview_width = 0;
    options.lights.sky_color = glm::vec3(1.0f, 2.0f, 4.0f);
    lumel::bake(scene_path("cornell-box"), folder / "baked", options);
    const Image written = read_exr(folder / "baked/lightmap.exr");

    Scene scene = Scene::load(scene_path("cornell-box"));
    scene.add_daylight({.sky_luminance = Vec3{1.0f, 2.0f, 4.0f}});
    const Baked baked =
        bake(Device(), scene, {.atlas = {.size = kSize}, .error = 0.0, .shots = kShots});
    EXPECT_EQ(baked.map.width, kSize);
    EXPECT_EQ(baked.shots, kShots);
    EXPECT_EQ(baked.map.rgba, written.values);
}

TEST(BakeInMemory, OfAFurnaceIsTheClosedForm)
{
    constexpr float kAlbedo = 0.5f, kLuminance = 10.0f;
    const Material glowing{.base_color = {kAlbedo, kAlbedo, kAlbedo, 1.0f},
                           .emitted = {kLuminance, kLuminance, kLuminance}};
    const Baked baked = bake(Device(), Scene(closed_cube(glowing)), {.atlas = {.size = kSize}});
    // B = E / (1 - ρ) everywhere, and H = B in a closed room.
    const double truth = std::numbers::pi * kLuminance / (1.0 - kAlbedo);
    EXPECT_NEAR(mean_of(baked.map), truth, 0.01 * truth);
}

TEST(BakeInMemory, HasASurfaceForEachPrimitiveOfAnInstance)
{
    SceneContent content = closed_cube({.emitted = {1, 1, 1}});
    content.instances.push_back(content.instances[0]);
    content.instances[1].transform[12] = 5.0f;
    const Baked baked =
        bake(Device(), Scene(content), {.atlas = {.size = kSize}, .error = 0.0, .shots = 16});
    ASSERT_EQ(baked.surfaces.size(), 2u);
    const Primitive& primitive = content.meshes[0].primitives[0];
    for (std::uint32_t i = 0; i < 2; ++i) {
        const Surface& surface = baked.surfaces[i];
        EXPECT_EQ(surface.instance, i);
        ASSERT_EQ(surface.indices.size(), primitive.indices.size());
        ASSERT_EQ(surface.lightmap.size(), surface.source_vertex.size());
        for (std::size_t corner = 0; corner < surface.indices.size(); ++corner)
            EXPECT_EQ(surface.source_vertex[surface.indices[corner]], primitive.indices[corner]);
        for (const Vec2& place : surface.lightmap)
            EXPECT_TRUE(place[0] >= 0 && place[0] <= 1 && place[1] >= 0 && place[1] <= 1);
    }
}

TEST(BakeInMemory, EndsWhenTheHostSaysSo)
{
    const Baked baked =
        bake(Device(), Scene::load(scene_path("cornell-box")), {.atlas = {.size = kSize}},
             [](const Progress& now) { return now.stage != "solving" || now.shots < 64; });
    EXPECT_TRUE(baked.interrupted);
    EXPECT_EQ(baked.map.width, kSize);
}

TEST(BakeInMemory, GivesItsMessagesToTheHost)
{
    SceneContent content = closed_cube({.emitted = {1, 1, 1}});
    content.meshes[0].primitives[0].indices.insert(content.meshes[0].primitives[0].indices.end(),
                                                   {0, 0, 1});
    const Scene scene(content);
    testing::internal::CaptureStderr();
    const Baked baked =
        bake(Device(), scene, {.atlas = {.size = kSize}, .error = 0.0, .shots = 16});
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    ASSERT_FALSE(baked.notes.empty());
    EXPECT_NE(baked.notes[0].find("zero area"), std::string::npos);
}

TEST(BakeInMemory, RefusesSettingsByName)
{
    const Device device;
    const Scene scene(closed_cube({}));
    const auto refuses = [&](const BakeSettings& settings, const char* word) {
        expect_error(ErrorKind::input, {word}, [&] { bake(device, scene, settings); });
    };
    refuses({.atlas = {.size = -1}}, "size");
    refuses({.atlas = {.size = 1 << 20}}, "size");
    refuses({.atlas = {.texels_per_metre = -1.0f}}, "texels_per_metre");
    refuses({.atlas = {.gutter = 65}}, "gutter");
    refuses({.method = "no such method"}, "no such method");
    refuses({.error = -1.0}, "error");
    refuses({.error = 0.0}, "nothing would end the bake");
    refuses({.seconds = -1.0}, "seconds");
    expect_error(ErrorKind::input, {"Materials::glossy"}, [&] {
        bake(device, Scene::load(scene_path("glossy-floor")), {.method = "glossy"});
    });
}

}  // namespace
}  // namespace lumel::v0
