// The interface for C gives the same maps of lamps and of daylight as lumel.h.

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "../support/temporary_folder.h"
#include "c_bakes.h"
#include "few_days.h"

namespace lumel::v0 {
namespace {

using namespace test;

/// The maps of lamps add up to the whole map.
void expect_sum_of_lamps(const lumel_baked& baked)
{
    for (std::size_t v = 0; v < std::size_t(4 * baked.map.width * baked.map.height); ++v) {
        if (v % 4 == 3)
            continue;
        float sum = 0.0f;
        for (const lumel_lamp& lamp : std::span(baked.lamps, baked.lamp_count))
            sum += lamp.map.rgba[v];
        ASSERT_NEAR(sum, baked.map.rgba[v], 1e-5f * baked.map.rgba[v]);
    }
}

/// The bake of a glowing cube with two lamps.
struct LitCube {
    Cube cube;
    std::array<lumel_light, 2> lamps{
        lumel_light{.name = "bulb", .intensity = 10.0f, .position = {0.3f, 0.2f, 0}},
        lumel_light{.name = "beam", .kind = LUMEL_SPOT, .color = {1, 0, 0}, .intensity = 5.0f}};

    ScenePointer scene() const
    {
        lumel_content content = cube.arrays();
        content.light_count = 2;
        content.lights = lamps.data();
        return scene_of(content);
    }
};

TEST(LumelC, GivesTheLightOfEachLamp)
{
    const LitCube lit;
    const ScenePointer scene = lit.scene();
    const BakedPointer baked =
        baked_of(scene.get(), {.size = kSize, .per_lamp = 1, .shots = kRays});
    expect_sum_of_lamps(*baked);
    SceneContent values = lit.cube.values();
    values.lights = {
        {.name = "bulb", .intensity = 10.0f, .position = {0.3f, 0.2f, 0}},
        {.kind = Light::Kind::spot, .name = "beam", .color = {1, 0, 0}, .intensity = 5.0f}};
    const std::vector<LampMap> same =
        bake(Scene(values), {.atlas = {.size = kSize}, .per_lamp = true, .shots = kRays}).lamps;
    ASSERT_EQ(baked->lamp_count, 3u);
    ASSERT_EQ(same.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
        const lumel_lamp& lamp = baked->lamps[k];
        const std::string name = lamp.name;
        EXPECT_EQ(name, same[k].name);
        EXPECT_EQ(lamp.kind, same[k].kind);
        ASSERT_EQ(lamp.member_count, 1u);
        EXPECT_EQ(lamp.members[0], name);
        EXPECT_EQ(lamp.map.width, kSize);
        EXPECT_EQ(lamp.map.height, kSize);
        const std::vector<float>& map = same[k].map.rgba;
        EXPECT_TRUE(std::ranges::equal(map, std::span(lamp.map.rgba, map.size())));
        EXPECT_EQ(lamp.error, same[k].error);
        EXPECT_TRUE(std::ranges::equal(lamp.color, same[k].color));
        EXPECT_EQ(std::ranges::max(lamp.color), 1.0);
        EXPECT_NEAR(lamp.color[1], name == "beam" ? 0.0 : 1.0, 1e-4);
    }
}

TEST(LumelC, JoinsLampsToGroups)
{
    const LitCube lit;
    const ScenePointer scene = lit.scene();
    lumel_lamp_group group{.name = "electric", .pattern = "b*"};
    lumel_settings settings{.size = kSize, .group_count = 1, .groups = &group, .shots = kRays};
    const BakedPointer baked = baked_of(scene.get(), settings);
    ASSERT_EQ(baked->lamp_count, 2u);
    expect_sum_of_lamps(*baked);
    const std::span lamps(baked->lamps, 2);
    const auto electric =
        std::ranges::find_if(lamps, [](const lumel_lamp& lamp) { return lamp.member_count == 2; });
    ASSERT_NE(electric, lamps.end());
    EXPECT_STREQ(electric->name, "electric");
    EXPECT_STREQ(electric->kind, "group");

    const lumel_baked* refused = nullptr;
    group.pattern = "nobody";
    expect_refusal(lumel_bake(nullptr, scene.get(), &settings, &refused), LUMEL_BAD_INPUT,
                   {"settings.groups", "nobody"});
    settings.groups = nullptr;
    expect_refusal(lumel_bake(nullptr, scene.get(), &settings, &refused), LUMEL_BAD_INPUT,
                   {"settings.groups", "NULL"});
    EXPECT_EQ(refused, nullptr);
}

/// A square that faces up.
TEST(LumelC, GivesTheDaylightOfLumelH)
{
    const float positions[] = {-1, 0, 1, 1, 0, 1, 1, 0, -1, -1, 0, -1};
    const std::uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    const lumel_material grey{.base_color = {0.5f, 0.5f, 0.5f, 1}};
    const lumel_mesh square{.vertex_count = 4,
                            .positions = positions,
                            .triangle_count = 2,
                            .indices = indices,
                            .material_count = 1,
                            .materials = &grey};
    const lumel_instance ground{.name = "ground", .mesh = &square};
    const ScenePointer scene = scene_of({.instance_count = 1, .instances = &ground});
    const lumel::test::TemporaryFolder folder;
    const std::string weather = weather_file(folder, few_days);
    const BakedPointer baked =
        baked_of(scene.get(), {.size = kSize, .weather_file = weather.c_str(), .shots = kRays});
    ASSERT_NE(baked->daylight, nullptr);
    const lumel_daylight_maps& daylight = *baked->daylight;

    SceneContent content;
    content.materials = {{.base_color = {0.5f, 0.5f, 0.5f, 1}}};
    content.meshes = {
        {.primitives = {{.positions = {{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}},
                         .indices = {0, 1, 2, 0, 2, 3}}}}};
    content.instances = {{.name = "ground"}};
    const DaylightMaps same =
        *bake(Scene(content), {.atlas = {.size = kSize}, .weather_file = weather, .shots = kRays})
             .daylight;
    EXPECT_STREQ(daylight.place, "Test");
    EXPECT_EQ(daylight.latitude, same.latitude);
    EXPECT_EQ(daylight.longitude, same.longitude);
    EXPECT_EQ(daylight.error, same.error);
    ASSERT_EQ(daylight.map_count, same.maps.size());
    for (std::size_t k = 0; k < same.maps.size(); ++k) {
        const Map& map = same.maps[k].map;
        EXPECT_EQ(daylight.maps[k].hour, same.maps[k].hour);
        EXPECT_EQ(daylight.maps[k].map.width, map.width);
        EXPECT_TRUE(
            std::ranges::equal(map.rgba, std::span(daylight.maps[k].map.rgba, map.rgba.size())));
    }
    ASSERT_EQ(daylight.hour_count, same.hours.size());
    for (std::size_t h = 0; h < same.hours.size(); ++h) {
        const lumel_daylight_hour& hour = daylight.hours[h];
        EXPECT_EQ(hour.hour, same.hours[h].hour);
        EXPECT_TRUE(std::ranges::equal(hour.sun, same.hours[h].sun));
        EXPECT_EQ(hour.lux, same.hours[h].lux);
        EXPECT_EQ(hour.mean, same.hours[h].mean);
        EXPECT_EQ(hour.error, same.hours[h].error);
        EXPECT_TRUE(
            std::ranges::equal(same.hours[h].weights, std::span(hour.weights, daylight.map_count)));
    }
}

TEST(LumelC, RefusesWeatherByASentence)
{
    const Cube cube;
    const ScenePointer scene = scene_of(cube.arrays());
    EXPECT_EQ(baked_of(scene.get(), {.size = kSize, .shots = kRays})->daylight, nullptr);
    const lumel_baked* baked = nullptr;
    lumel_settings settings{.size = kSize, .weather_file = "no.epw", .shots = kRays};
    expect_refusal(lumel_bake(nullptr, scene.get(), &settings, &baked), LUMEL_BAD_INPUT,
                   {"settings.weather_file: no.epw: "});
    const lumel::test::TemporaryFolder folder;
    const std::string dark = weather_file(folder, [](int) { return support::WeatherOfHour{}; });
    settings.weather_file = dark.c_str();
    expect_refusal(lumel_bake(nullptr, scene.get(), &settings, &baked), LUMEL_BAD_INPUT,
                   {"settings.weather_file: ", "made.epw: line 8768: "});
    EXPECT_EQ(baked, nullptr);
}

}  // namespace
}  // namespace lumel::v0
