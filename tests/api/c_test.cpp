// The interface for C gives the same scenes, maps and files as lumel.h.

#include <limits>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "c_bakes.h"

namespace lumel::v0 {
namespace {

using namespace test;

/// That the surfaces are those of `wanted`, with the vertices of the cube's one mesh.
void expect_surfaces(const lumel_baked& baked, const Baked& wanted, const Cube& cube)
{
    const std::vector<Primitive> primitives = cube.values().meshes[0].primitives;
    ASSERT_EQ(baked.surface_count, wanted.surfaces.size());
    for (std::uint32_t s = 0; s < baked.surface_count; ++s) {
        const lumel_surface& surface = baked.surfaces[s];
        const Surface& same = wanted.surfaces[s];
        EXPECT_EQ(surface.instance, same.instance);
        EXPECT_EQ(surface.primitive, same.primitive);
        EXPECT_EQ(surface.texels_per_metre, same.texels_per_metre);
        EXPECT_EQ(surface.page, nullptr);
        EXPECT_TRUE(std::ranges::equal(std::span(surface.indices, 3 * surface.triangle_count),
                                       same.indices));
        ASSERT_EQ(surface.vertex_count, same.lightmap.size());
        for (std::uint32_t v = 0; v < surface.vertex_count; ++v) {
            EXPECT_EQ(surface.lightmap[2 * v], same.lightmap[v][0]);
            EXPECT_EQ(surface.lightmap[2 * v + 1], same.lightmap[v][1]);
            const float* const position = cube.mesh.positions + 3 * surface.source_vertex[v];
            const Vec3& expected = primitives[same.primitive].positions[same.source_vertex[v]];
            for (std::size_t c = 0; c < 3; ++c)
                EXPECT_EQ(position[c], expected[c]);
        }
    }
}

TEST(LumelC, IsOfTheSameVersion)
{
    EXPECT_EQ(lumel_version(), version());
}

TEST(LumelC, GivesTheBakeOfLumelH)
{
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    const BakedPointer baked = baked_of(scene.get(), {.size = kSize, .seed = 7});
    const Baked same = bake(Scene(cube.values()), {.atlas = {.size = kSize}, .seed = 7});
    ASSERT_EQ(baked->map.width, kSize);
    EXPECT_TRUE(
        std::ranges::equal(same.map.rgba, std::span(baked->map.rgba, same.map.rgba.size())));
    EXPECT_EQ(baked->shots, same.shots);
    EXPECT_EQ(baked->eye_error, same.eye_error);
    EXPECT_EQ(baked->interrupted, 0);
    EXPECT_EQ(baked->page_count, 1u);
    EXPECT_EQ(baked->pages[0].side, kSize);
    expect_surfaces(*baked, same, cube);
}

TEST(LumelC, GivesProbesAndFiles)
{
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    const BakedPointer baked = baked_of(scene.get(), {.size = kSize});
    const Baked same = bake(Scene(cube.values()), {.atlas = {.size = kSize}});
    const float place[3] = {0.1f, 0.2f, 0.3f};
    lumel_probe probe{};
    ASSERT_EQ(lumel_probes(baked.get(), place, 1, 0, &probe), LUMEL_OK) << lumel_message();
    const Probe wanted = probes(same, {{0.1f, 0.2f, 0.3f}}).front();
    for (std::size_t i = 0; i < 9; ++i)
        EXPECT_EQ(probe.coefficients[i][1], wanted.coefficients[i][1]);
    EXPECT_EQ(probe.inside, 0);

    const lumel::test::TemporaryFolder folder;
    write_scene(folder / "cpp.glb", same, LightmapFormat::png);
    ASSERT_EQ(lumel_write_scene(baked.get(), (folder / "c.glb").c_str(), LUMEL_PNG), LUMEL_OK);
    EXPECT_EQ(bytes_of(folder / "c.glb"), bytes_of(folder / "cpp.glb"));
    ASSERT_EQ(lumel_write_baked_scene(baked.get(), (folder / "lit.glb").c_str(), 0), LUMEL_OK);
    EXPECT_GT(bytes_of(folder / "lit.glb").size(), 0u);
    expect_refusal(lumel_write_scene(baked.get(), (folder / "no/c.glb").c_str(), LUMEL_PNG),
                   LUMEL_BAD_OUTPUT, {"c.glb"});
}

TEST(LumelC, ReadsFilesWithDaylight)
{
    lumel_scene* read = nullptr;
    ASSERT_EQ(lumel_load_scene(scene_path("cornell-box").c_str(), &read), LUMEL_OK);
    const ScenePointer scene(read);
    const float sky[3] = {1.0f, 2.0f, 4.0f};
    const lumel_daylight daylight{.sky_luminance = sky,
                                  .has_sun = 1,
                                  .sun_azimuth = 2.0,
                                  .sun_elevation = 0.5,
                                  .sky_scale = 2.0f,
                                  .rotation = 0.25,
                                  .ground = 0.2f};
    ASSERT_EQ(lumel_add_daylight(scene.get(), &daylight), LUMEL_OK) << lumel_message();
    const BakedPointer baked = baked_of(scene.get(), {.size = kSize, .shots = 12});
    Scene same = Scene::load(scene_path("cornell-box"));
    same.add_daylight({.sky_luminance = Vec3{1.0f, 2.0f, 4.0f},
                       .sun = Daylight::Sun{.azimuth = 2.0, .elevation = 0.5},
                       .sky_scale = 2.0f,
                       .ground = 0.2f,
                       .rotation = 0.25});
    const Baked wanted = bake(same, {.atlas = {.size = kSize}, .shots = 12});
    EXPECT_TRUE(
        std::ranges::equal(wanted.map.rgba, std::span(baked->map.rgba, wanted.map.rgba.size())));
    ASSERT_EQ(baked->note_count, wanted.notes.size());
    ASSERT_GT(baked->note_count, 0u);
    EXPECT_NE(std::strstr(baked->notes[0], "daylight.sky_scale"), nullptr) << baked->notes[0];
}

/// That a bake by C arrays is one by the same values.
void expect_same_bake(const lumel_content& content, const SceneContent& values,
                      const lumel_settings& settings, const BakeSettings& same)
{
    const ScenePointer scene = scene_of(content);
    const BakedPointer baked = baked_of(scene.get(), settings);
    const Baked wanted = bake(Scene(values), same);
    ASSERT_EQ(std::size_t(baked->map.width) * std::size_t(baked->map.height) * 4,
              wanted.map.rgba.size());
    EXPECT_TRUE(
        std::ranges::equal(wanted.map.rgba, std::span(baked->map.rgba, wanted.map.rgba.size())));
    EXPECT_EQ(baked->surface_count, wanted.surfaces.size());
    EXPECT_EQ(baked->page_count, wanted.pages.size());
}

TEST(LumelC, TakesLooksAndPlaces)
{
    Cube cube;
    const std::uint8_t rgba[8] = {255, 0, 0, 255, 0, 255, 0, 64};
    const lumel_texture texture{.width = 2, .height = 1, .rgba = rgba};
    cube.materials[0].base_color_texture = &texture;
    cube.materials[0].alpha = LUMEL_BLEND;
    cube.materials[0].double_sided = 1;
    cube.materials[1].emitted_texture = &texture;
    SceneContent values = cube.values();
    const std::size_t vertices = cube.mesh.vertex_count;
    std::vector<Vec2> texcoords(vertices);
    std::vector<Vec3> normals(vertices);
    std::vector<Vec4> colors(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        const float* const position = cube.mesh.positions + 3 * v;
        texcoords[v] = {position[0], position[1]};
        normals[v] = {-position[0], -position[1], -position[2]};
        colors[v] = {1.0f, 0.5f, 0.25f, 1.0f};
    }
    cube.mesh.texcoords = texcoords[0].data();
    cube.mesh.normals = normals[0].data();
    cube.mesh.colors = colors[0].data();
    values.textures = {{2, 1, {rgba, rgba + 8}}};
    values.materials[0].base_color_texture = values.materials[1].emitted_texture = 0;
    values.materials[0].alpha = Alpha::blend;
    values.materials[0].double_sided = true;
    for (Primitive& primitive : values.meshes[0].primitives) {
        primitive.texcoords = texcoords;
        primitive.normals = normals;
        primitive.colors = colors;
    }
    lumel_instance twice[2] = {cube.instance, cube.instance};
    twice[1].name = "second";
    for (const int diagonal : {0, 5, 10, 15})
        twice[1].transform[diagonal] = 1.0f;
    twice[1].transform[12] = 5.0f;
    values.instances.push_back(values.instances[0]);
    values.instances[1].name = "second";
    values.instances[1].transform[12] = 5.0f;
    const lumel_light sun{.kind = LUMEL_DIRECTIONAL,
                          .intensity = 100.0f,
                          .direction = {1.0f, -2.0f, 0.5f},
                          .angle = 0.01f};
    values.lights = {{.kind = Light::Kind::directional,
                      .intensity = 100.0f,
                      .direction = {1.0f, -2.0f, 0.5f},
                      .angle = 0.01f}};
    lumel_content content{
        .instance_count = 2, .instances = twice, .light_count = 1, .lights = &sun};
    const lumel_density density{.pattern = "second", .texels_per_metre = 10.0f};
    const lumel_settings settings{.texels_per_metre = 5.0f,
                                  .max_size = 2 * kSize,
                                  .pages = 4,
                                  .sides = LUMEL_SIDES_FRONT,
                                  .density_count = 1,
                                  .densities = &density,
                                  .parts = LUMEL_DIRECT_LIGHT,
                                  .shots = 12};
    expect_same_bake(content, values, settings,
                     {.atlas = {.texels_per_metre = 5.0f,
                                .max_size = 2 * kSize,
                                .pages = 4,
                                .sides = Sides::front,
                                .densities = {{"second", 10.0f}}},
                      .parts = Parts::direct,
                      .shots = 12});
}

TEST(LumelC, TakesSkiesOfTheCie)
{
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    lumel_daylight daylight{.cie_sky = 12, .cie_lux = 500.0f};
    expect_refusal(lumel_add_daylight(scene.get(), &daylight), LUMEL_BAD_INPUT, {"cie:12", "sun"});
    daylight.cie_sky = 17;
    expect_refusal(lumel_add_daylight(scene.get(), &daylight), LUMEL_BAD_INPUT, {"16"});
    daylight.cie_sky = 12;
    daylight.has_sun = LUMEL_SUN_OF_SKY;
    daylight.sun_elevation = 0.5;
    EXPECT_EQ(lumel_add_daylight(scene.get(), &daylight), LUMEL_OK) << lumel_message();
    daylight.has_sun = LUMEL_NO_SUN;
    daylight.cie_sky = 3;
    EXPECT_EQ(lumel_add_daylight(scene.get(), &daylight), LUMEL_OK) << lumel_message();
}

/// A material that no triangle has, a triangle without area, and a mesh without triangles.
TEST(LumelC, LeavesOutWhatShowsNothing)
{
    Cube cube;
    const lumel_mesh empty{.material_count = 3};
    const lumel_instance instances[2] = {{.mesh = &empty}, cube.instance};
    cube.of_triangle.assign(12, 1);
    std::vector<std::uint32_t> indices(cube.mesh.indices, cube.mesh.indices + 36);
    indices[4] = indices[3];
    cube.mesh.indices = indices.data();
    const ScenePointer scene = scene_of({.instance_count = 2, .instances = instances});
    const BakedPointer baked = baked_of(scene.get(), {.size = kSize, .shots = 12});
    ASSERT_EQ(baked->surface_count, 1u);
    EXPECT_EQ(baked->surfaces[0].instance, 1u);
    EXPECT_EQ(baked->surfaces[0].primitive, 1u);
    EXPECT_EQ(baked->surfaces[0].triangle_count, 11u);
}

TEST(LumelC, TakesLampsAndSkies)
{
    Cube cube;
    cube.of_triangle.assign(12, 0);
    const lumel_light lamps[2] = {{.name = "bulb", .intensity = 10.0f},
                                  {.name = "spot",
                                   .kind = LUMEL_SPOT,
                                   .color = {1, 0, 0},
                                   .intensity = 5.0f,
                                   .position = {0, 0.5f, 0},
                                   .radius = 0.05f}};
    const float luminance[3] = {5.0f, 5.0f, 5.0f};
    const lumel_sky sky{.width = 1, .height = 1, .luminance = luminance};
    lumel_content content = cube.arrays();
    content.light_count = 2;
    content.lights = lamps;
    content.sky = &sky;
    const ScenePointer scene = scene_of(content);
    const BakedPointer baked = baked_of(scene.get(), {.size = kSize, .shots = 12});
    SceneContent same = cube.content;
    same.lights = {{.name = "bulb", .intensity = 10.0f},
                   {.kind = Light::Kind::spot,
                    .name = "spot",
                    .color = {1, 0, 0},
                    .intensity = 5.0f,
                    .position = {0, 0.5f, 0},
                    .radius = 0.05f}};
    same.sky = {.width = 1, .height = 1, .luminance = {{5.0f, 5.0f, 5.0f}}};
    const Baked wanted = bake(Scene(same), {.atlas = {.size = kSize}, .shots = 12});
    EXPECT_TRUE(
        std::ranges::equal(wanted.map.rgba, std::span(baked->map.rgba, wanted.map.rgba.size())));
}

TEST(LumelC, StopsWhenProgressSaysSo)
{
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    int calls = 0;
    lumel_settings settings{.size = kSize};
    settings.user = &calls;
    settings.progress = [](const lumel_progress* now, void* user) {
        EXPECT_NE(now->stage[0], '\0');
        ++*static_cast<int*>(user);
        return 0;
    };
    const lumel_baked* baked = nullptr;
    expect_refusal(lumel_bake(nullptr, scene.get(), &settings, &baked), LUMEL_STOPPED, {});
    EXPECT_EQ(baked, nullptr);
    EXPECT_GT(calls, 0);
}

TEST(LumelC, TellsWarnings)
{
    Cube cube;
    cube.materials[0].base_color[0] = 1.0f;
    std::vector<std::string> heard;
    lumel_on_warning(
        [](const char* message, void* user) {
            static_cast<std::vector<std::string>*>(user)->emplace_back(message);
        },
        &heard);
    const ScenePointer scene = scene_of(cube.arrays());
    lumel_on_warning(nullptr, nullptr);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_NE(heard[0].find("white"), std::string::npos);
}

TEST(LumelC, RefusesWithASentence)
{
    Cube cube;
    const lumel_content content = cube.arrays();
    lumel_scene* scene = nullptr;
    expect_refusal(lumel_make_scene(nullptr, &scene), LUMEL_BAD_INPUT, {"content", "NULL"});
    expect_refusal(lumel_load_scene("nowhere.glb", &scene), LUMEL_BAD_INPUT, {"nowhere.glb"});
    cube.of_triangle[3] = 2;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT,
                   {"meshes[0].triangle_materials[3]", "2 materials"});
    cube.of_triangle[3] = 0;
    cube.mesh.vertex_count = 4;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT, {"meshes[0].indices[6]"});
    cube.mesh.vertex_count = 24;
    std::vector<float> positions(cube.mesh.positions, cube.mesh.positions + 72);
    positions[3 * 17 + 1] = std::numeric_limits<float>::quiet_NaN();
    cube.mesh.positions = positions.data();
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT,
                   {"meshes[0].positions[17]"});
    cube.mesh.material_count = 0;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT, {"no materials"});
    cube.mesh.material_count = 2;
    cube.mesh.positions = cube.content.meshes[0].primitives[0].positions[0].data();
    cube.instance.transform[3] = 1.0f;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT,
                   {"instances[0]", "column by column"});
    cube.instance.transform[3] = 0.0f;
    const lumel_texture endless{.width = 1 << 30, .height = 1 << 30, .rgba = &kNoTexel};
    cube.materials[0].base_color_texture = &endless;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT, {"textures[0]", "65536"});
    cube.materials[0].base_color_texture = nullptr;
    cube.mesh.positions = nullptr;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT, {"meshes[0].positions"});
    cube.instance.mesh = nullptr;
    expect_refusal(lumel_make_scene(&content, &scene), LUMEL_BAD_INPUT, {"instances[0].mesh"});
    EXPECT_EQ(scene, nullptr);

    const Cube whole;
    const ScenePointer made = scene_of(whole.arrays());
    const lumel_baked* baked = nullptr;
    const auto refused = [&](const lumel_settings& settings,
                             std::initializer_list<const char*> words) {
        expect_refusal(lumel_bake(nullptr, made.get(), &settings, &baked), LUMEL_BAD_INPUT, words);
    };
    refused({.method = "mc"}, {"mc", "method"});
    refused({.method = "stochastic"}, {"stochastic", "device"});
    refused({.sides = 9}, {"settings.sides"});
    refused({.error = -1.0}, {"settings.error"});
    refused({.size = -1}, {"settings.size"});
    const char* const odd[] = {"filter", nullptr};
    refused({.options = odd}, {"filter", "NULL"});
    EXPECT_EQ(baked, nullptr);
    expect_refusal(lumel_bake(nullptr, nullptr, nullptr, &baked), LUMEL_BAD_INPUT, {"scene"});
    expect_refusal(lumel_open_device("no such device", nullptr), LUMEL_BAD_INPUT, {"device"});
    lumel_free_scene(nullptr);
    lumel_free_baked(nullptr);
    lumel_close_device(nullptr);
}

TEST(LumelC, TakesOptionsOfMethodsOnADevice)
{
    lumel_device* opened = nullptr;
    ASSERT_EQ(lumel_open_device(nullptr, &opened), LUMEL_OK) << lumel_message();
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    const char* const options[] = {"hemicube", "64", nullptr};
    const lumel_settings settings{.size = kSize,
                                  .method = "stochastic",
                                  .options = options,
                                  .directional = LUMEL_SH2,
                                  .shots = 64};
    const lumel_baked* baked = nullptr;
    EXPECT_EQ(lumel_bake(opened, scene.get(), &settings, &baked), LUMEL_OK) << lumel_message();
    ASSERT_NE(baked, nullptr);
    const Baked same = bake(Device(), Scene(cube.values()),
                            {.atlas = {.size = kSize},
                             .method = "stochastic",
                             .options = {{"hemicube", "64"}},
                             .directional = Directional::sh2,
                             .shots = 64});
    EXPECT_TRUE(
        std::ranges::equal(same.map.rgba, std::span(baked->map.rgba, same.map.rgba.size())));
    EXPECT_EQ(baked->directional_count, 9u);
    EXPECT_EQ(baked->directional[8].width, kSize);
    lumel_free_baked(baked);
    lumel_close_device(opened);
}

}  // namespace
}  // namespace lumel::v0
