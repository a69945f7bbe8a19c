// Bakes in memory.

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "api/fields.h"
#include "base/images/image_files.h"
#include "boxes.h"
#include "jobs/bake/bake.h"

namespace lumel::v0 {
namespace {

using namespace test;

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

TEST(BakeInMemory, WithoutLimitsHasThoseOfTheProgram)
{
    const lumel::test::TemporaryFolder folder;
    BakeOptions options;
    options.atlas.size = kSize;
    options.solver.max_shots = 96;
    options.solver.target_error = 0.0;
    options.solver.target_quality = {.visible_noise = 0.005, .eye_error = 0.05};
    options.preview_width = 0;
    lumel::bake(scene_path("cornell-box"), folder / "baked", options);
    const Image written = read_exr(folder / "baked/lightmap.exr");
    const Baked baked =
        bake(Device(), Scene::load(scene_path("cornell-box")), {.atlas = {.size = kSize}});
    EXPECT_EQ(baked.map.rgba, written.values);
    EXPECT_GE(baked.eye_error, 0.0);
}

TEST(BakeInMemory, OfDoubleSidedWallsHasTheLightOfEachSide)
{
    const Device device;
    const AtlasSettings atlas{.size = 2 * kSize};
    const SceneContent house = paper_house(true);
    const Baked lit = bake(device, Scene(house), {.atlas = atlas}),
                dark = bake(device, Scene(paper_house(false)), {.atlas = atlas});
    expect_two_sides(lit.surfaces, lit.map, house,
                     light_of_ceiling(dark.surfaces, dark.map, house));
    AtlasSettings front = atlas;
    front.sides = Sides::front;
    const Baked one = bake(device, Scene(house), {.atlas = front});
    EXPECT_EQ(one.surfaces.size(), 1u);
    EXPECT_NEAR(light_of_ceiling(one.surfaces, one.map, house),
                light_of_ceiling(dark.surfaces, dark.map, house), 2.0);
}

/// A closed box and a sheet beside it, in one primitive, between two suns: light reaches both sides
/// of the sheet alone.
TEST(BakeInMemory, HasBacksOfAllTrianglesIfSomeAreLitOnBothSides)
{
    SceneContent content = paper_house(true);
    content.lights[0] = content.lights[1];
    content.lights[0].direction = {0.0f, 1.0f, 0.0f};
    Primitive& primitive = content.meshes[0].primitives[0];
    const auto first = std::uint32_t(primitive.positions.size());
    primitive.positions.insert(primitive.positions.end(),
                               {{3, 0, 0}, {3, 0, 1}, {4, 0, 1}, {4, 0, 0}});
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        primitive.indices.push_back(first + i);
    const Baked baked = bake(Device(), Scene(content), {.atlas = {.size = 2 * kSize}});
    ASSERT_EQ(baked.surfaces.size(), 2u);
    const Surface &front = baked.surfaces[0], &back = baked.surfaces[1];
    EXPECT_TRUE(back.back);
    ASSERT_EQ(back.indices.size(), front.indices.size());
    int own = 0;
    for (std::size_t t = 0; t < front.indices.size(); t += 3) {
        EXPECT_EQ(back.indices[t + 1], front.indices[t + 2]);
        own += back.lightmap[back.indices[t]] != front.lightmap[back.indices[t]];
    }
    EXPECT_EQ(own, 2);
}

TEST(BakeInMemory, ThatNoLightReachesHasNoErrorAndANote)
{
    SceneContent content = closed_cube({});
    content.lights = {{.name = "outside", .intensity = 10.0f, .position = {0.0f, 5.0f, 0.0f}}};
    const Baked baked = bake(Device(), Scene(content), {.atlas = {.size = kSize}});
    EXPECT_LT(baked.error, 0.0);
    EXPECT_LT(baked.eye_error, 0.0);
    EXPECT_NE(std::ranges::find(baked.notes, "no light reaches any surface: the lightmap is black"),
              baked.notes.end());
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

TEST(BakeInMemory, OnPagesIsOfOneDensityAndEachPageHoldsItsSurfaces)
{
    const Scene scene = Scene::load(scene_path("cornell-box"));
    const AtlasSettings one{.size = 64};
    AtlasSettings four = one;
    four.pages = 4;
    const auto bake_on = [&](const AtlasSettings& atlas) {
        return bake(Device(), scene, {.atlas = atlas, .error = 0.0, .shots = 24});
    };
    const Baked a = bake_on(one), b = bake_on(four);
    ASSERT_EQ(a.pages.size(), 1u);
    EXPECT_TRUE(a.surfaces.at(0).page.empty());
    ASSERT_GT(b.pages.size(), 1u);
    ASSERT_LE(b.pages.size(), 4u);
    EXPECT_GT(b.texels_per_metre, 1.3f * a.texels_per_metre);
    for (const Surface& surface : b.surfaces) {
        EXPECT_EQ(surface.texels_per_metre, b.texels_per_metre);
        ASSERT_EQ(surface.page.size(), surface.lightmap.size());
        for (std::size_t v = 0; v < surface.page.size(); ++v) {
            const Page& page = b.pages.at(surface.page[v]);
            const float x = surface.lightmap[v][0] * float(b.map.width) - float(page.x),
                        y = surface.lightmap[v][1] * float(b.map.height) - float(page.y);
            EXPECT_TRUE(x >= 0.0f && x <= float(page.side) && y >= 0.0f && y <= float(page.side));
        }
    }
    const Page page = b.pages[1];
    const Map part = cut_page(b.map, page);
    EXPECT_EQ(part.width, 64);
    ASSERT_EQ(part.rgba.size(), 64u * 64u * 4u);
    for (int y = 0; y < page.side; ++y)
        for (int x = 0; x < 4 * page.side; ++x)
            ASSERT_EQ(part.rgba[std::size_t(4 * page.side * y + x)],
                      b.map.rgba[std::size_t(4 * (b.map.width * (page.y + y) + page.x) + x)]);
    expect_error(ErrorKind::input, {"page"}, [&] { cut_page(a.map, page); });
}

TEST(BakeInMemory, HasTheDensityThatARuleSets)
{
    const Scene scene = Scene::load(scene_path("cornell-box"));
    const Baked baked =
        bake(Device(), scene,
             {.atlas = {.texels_per_metre = 30.0f, .densities = {{"*", 50.0f}, {"* block", 80.0f}}},
              .error = 0.0,
              .shots = 24});
    int dense = 0;
    for (const Surface& surface : baked.surfaces) {
        EXPECT_TRUE(surface.texels_per_metre == 50.0f || surface.texels_per_metre == 80.0f);
        dense += surface.texels_per_metre == 80.0f;
    }
    EXPECT_GT(dense, 0);
    EXPECT_LT(dense, int(baked.surfaces.size()));
    expect_error(ErrorKind::input, {"densities", "wall"}, [&] {
        bake(Device(), scene, {.atlas = {.densities = {{"wall", -1.0f}}}});
    });
}

TEST(BakeInMemory, EndsWhenTheHostSaysSo)
{
    const Baked baked = bake(
        Device(), Scene::load(scene_path("cornell-box")), {.atlas = {.size = kSize}, .error = 1e-6},
        [](const Progress& now) { return now.stage != "solving" || now.shots < 64; });
    EXPECT_TRUE(baked.interrupted);
    EXPECT_EQ(baked.map.width, kSize);
}

TEST(Messages, SpeakOfFieldsAndLeaveNamesOfFiles)
{
    EXPECT_EQ(in_fields("--size: raise --max-memory (--rays host), not --unknown of a--size.glb"),
              "AtlasSettings::size: raise BakeSettings::max_memory "
              "(BakeSettings::options[\"rays\"] host), not --unknown of a--size.glb");
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
    refuses({.atlas = {.sides = Sides::both}, .method = "matrix"}, "AtlasSettings::sides both");
    refuses({.method = "mc"}, "BakeSettings::method mc: no such method");
    refuses({.options = {{"patches", "512"}}},
            "BakeSettings::options[\"patches\"]: is not read by BakeSettings::method links");
    refuses({.options = {{"sides", "both"}}}, "sides: is not an option of any method");
    refuses({.method = "directions", .dark_error = 0.1}, "BakeSettings::dark_error");
    refuses({.options = {{"seed", "2"}}}, "seed");
    refuses({.error = -1.0}, "error");
    refuses({.error = 0.0}, "nothing would end the bake");
    refuses({.seconds = -1.0}, "seconds");
    expect_error(ErrorKind::device, {"BakeSettings::max_memory allows"},
                 [&] { bake(device, scene, {.atlas = {.size = 512}, .max_memory = 1 << 20}); });
    expect_error(ErrorKind::input, {"Materials::glossy"}, [&] {
        bake(device, Scene::load(scene_path("glossy-floor")), {.method = "glossy"});
    });
}

}  // namespace
}  // namespace lumel::v0
