// Scenes kept lit by a host over links.

#include <cmath>
#include <fstream>
#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "../support/temporary_folder.h"
#include "boxes.h"

namespace lumel::v0 {
namespace {

using namespace test;

constexpr float kNoNumber = std::numeric_limits<float>::quiet_NaN();

/// A room with a box that may move, and a lamp of its own beside the shining ceiling.
Scene room()
{
    return Scene::load(scene_path("moving-large-lamp"));
}

LiveLinksSettings link_settings_for(const Scene& scene)
{
    return {.atlas = {.size = kSize}, .movers = {scene.find_instance("box")}};
}

Mat4 shifted(const Mat4& transform, const Vec3& by)
{
    Mat4 result = transform;
    for (std::size_t c = 0; c < 3; ++c)
        result[12 + c] += by[c];
    return result;
}

/// The six sides of a cube of white paint with a lamp in it.
SceneContent lit_cube()
{
    SceneContent content =
        test::closed_cube({.name = "paint", .base_color = {0.5f, 0.5f, 0.5f, 1}});
    content.lights = {{.name = "bulb", .intensity = 10.0f}};
    return content;
}

TEST(LiveLinkScenes, AreAsBrightAsTheirLamps)
{
    LiveLinks live(Scene(lit_cube()), {.atlas = {.size = kSize}});
    EXPECT_TRUE(live.update(kUntilAtRest).at_rest);
    const double bright = mean_of(live.map());
    EXPECT_GT(bright, 0.0);
    live.set_lamp("bulb", {2.0f, 2.0f, 2.0f});
    EXPECT_FALSE(live.state().at_rest);
    EXPECT_LE(live.update(0.0).residual, 1.0);
    EXPECT_TRUE(live.update(kUntilAtRest).at_rest);
    EXPECT_NEAR(mean_of(live.map()), 2.0 * bright, 2e-3 * bright);
    live.set_lamp("bulb", {0.0f, 0.0f, 0.0f});
    live.update(kUntilAtRest);
    EXPECT_EQ(mean_of(live.map()), 0.0);
    EXPECT_EQ(live.surfaces().size(), 1u);
}

TEST(LiveLinkScenes, OfDoubleSidedWallsHaveTheLightOfEachSide)
{
    const AtlasSettings atlas{.size = 2 * kSize};
    const SceneContent house = paper_house(true);
    LiveLinks lit(Scene(house), {.atlas = atlas}),
        dark(Scene(paper_house(false)), {.atlas = atlas});
    lit.update(kUntilAtRest);
    dark.update(kUntilAtRest);
    const double ceiling = light_of_ceiling(dark.surfaces(), dark.map(), house);
    expect_two_sides(lit.surfaces(), lit.map(), house, ceiling);
    lit.set_lamp("sun", {0.0f, 0.0f, 0.0f});
    lit.update(kUntilAtRest);
    EXPECT_NEAR(light_of_ceiling(lit.surfaces(), lit.map(), house), ceiling, 0.1 * ceiling);
}

TEST(LiveLinkScenes, HaveOneSideOfMovers)
{
    SceneContent content = paper_house(true);
    content.instances.push_back(content.instances[0]);
    content.instances[1].transform[12] = 5.0f;
    LiveLinks live{Scene(content), {.atlas = {.size = 2 * kSize}, .movers = {0}}};
    ASSERT_EQ(live.surfaces().size(), 2u);
    EXPECT_FALSE(live.surfaces()[1].back);
    content.lights[0].position = {5.0f, 0.0f, 0.0f};  // in the one that stays
    LiveLinks lit{Scene(content), {.atlas = {.size = 2 * kSize}, .movers = {0}}};
    ASSERT_EQ(lit.surfaces().size(), 3u);
    EXPECT_TRUE(lit.surfaces()[2].back);
    EXPECT_EQ(lit.surfaces()[2].instance, 1u);
}

/// All the light of the lamp falls on the walls, which return the share that they reflect, and so
/// on: H = D / (1 - ρ), but for lumels that lie half outside of their wall and count as whole.
TEST(LiveLinkScenes, PaintReflectsAsMuchAsItSays)
{
    LiveLinks live(Scene(lit_cube()), {.atlas = {.size = 2 * kSize}});
    const auto mean_with = [&](float albedo) {
        live.set_color("paint", {albedo, albedo, albedo});
        live.update(kUntilAtRest);
        return mean_of(live.lumels());
    };
    const double direct = mean_with(0.0f);
    constexpr double kFlux = 4.0 * 3.14159265358979 * 10.0, kArea = 24.0;
    EXPECT_NEAR(direct * kArea / kFlux, 1.0, 0.05);
    for (const float albedo : {0.5f, 0.2f, 0.8f})
        EXPECT_NEAR(mean_with(albedo) * (1.0 - double(albedo)) / direct, 1.0, 0.03);
}

TEST(LiveLinkScenes, MovedAndMovedBackAreLitAsBefore)
{
    const Scene scene = room();
    const std::uint32_t box = scene.find_instance("box");
    const Mat4 start = scene.instances()[box].transform;
    LiveLinks live(scene, link_settings_for(scene));
    live.update(kUntilAtRest);
    const Map before = live.lumels();
    live.move(box, shifted(start, {0.3f, 0.0f, 0.2f}));
    EXPECT_FALSE(live.state().at_rest);
    EXPECT_EQ(live.lumels().rgba, before.rgba) << "until the move is followed";
    int calls = 1;
    while (live.update(0.0).under_way)
        ++calls;
    EXPECT_GT(calls, 1);
    live.update(kUntilAtRest);
    EXPECT_NE(live.lumels().rgba, before.rgba);

    live.move(box, start);
    live.update(kUntilAtRest);
    const Map after = live.lumels();
    double squares = 0.0, count = 0.0;
    for (std::size_t i = 0; i < after.rgba.size(); ++i) {
        squares += std::pow(double(after.rgba[i] - before.rgba[i]), 2.0);
        count += 1.0;
    }
    EXPECT_LT(std::sqrt(squares / count), 5e-4 * mean_of(before));
}

double difference(const Map& one, const Map& other)
{
    double squares = 0.0, count = 0.0;
    for (std::size_t i = 0; i < one.rgba.size(); ++i) {
        squares += std::pow(double(one.rgba[i] - other.rgba[i]), 2.0);
        count += 1.0;
    }
    return std::sqrt(squares / count);
}

TEST(LiveLinkScenes, AreBakedUntilTheNextEdit)
{
    const Scene scene = room();
    const std::uint32_t box = scene.find_instance("box");
    LiveLinks live(scene, link_settings_for(scene));
    live.move(box, shifted(scene.instances()[box].transform, {0.3f, 0.0f, 0.2f}));
    const double error = live.bake(0.01);
    EXPECT_TRUE(live.state().at_rest);
    EXPECT_GT(error, 0.0);
    EXPECT_LE(error, 0.01);
    const Map baked = live.lumels();
    LiveLinks other(scene, link_settings_for(scene));
    other.move(box, shifted(scene.instances()[box].transform, {0.3f, 0.0f, 0.2f}));
    other.update(kUntilAtRest);
    EXPECT_GT(difference(other.lumels(), baked), 0.0);
    EXPECT_LT(difference(other.lumels(), baked), 0.1 * mean_of(baked));
    other.bake(0.01);
    EXPECT_EQ(other.lumels().rgba, baked.rgba);
    live.set_color("white", {0.1f, 0.1f, 0.1f});
    live.update(kUntilAtRest);
    EXPECT_NE(live.lumels().rgba, baked.rgba);
    EXPECT_THROW(live.bake(0.0), Error);
}

/// The room as it would lie on a map, so far out that floats are coarse.
Scene far_room(const lumel::test::TemporaryFolder& folder, const Vec3& offset)
{
    std::ifstream file(scene_path("moving-large-lamp"));
    nlohmann::json gltf = nlohmann::json::parse(file);
    nlohmann::json& roots = gltf["scenes"][0]["nodes"];
    gltf["nodes"].push_back({{"translation", offset}, {"children", roots}});
    roots = {gltf["nodes"].size() - 1};
    std::ofstream(folder / "far.gltf") << gltf;
    return Scene::load(folder / "far.gltf");
}

TEST(LiveLinkScenes, FarOutThingsMoveInTheWorldOfTheirFile)
{
    const lumel::test::TemporaryFolder folder;
    const Vec3 offset{1048576.0f, 0.0f, 2097152.0f}, shift{0.25f, 0.0f, 0.25f};
    const Scene near = room(), far = far_room(folder, offset);
    const std::uint32_t box = near.find_instance("box");
    const Mat4 here = near.instances()[box].transform, there = far.instances()[box].transform;
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(there[12 + c], here[12 + c] + offset[c], 0.2);
    LiveLinks live(near, link_settings_for(near)), out(far, link_settings_for(far));
    live.update(kUntilAtRest);
    out.update(kUntilAtRest);
    const double before = mean_of(live.map());
    EXPECT_NEAR(mean_of(out.map()), before, 0.005 * before);
    out.move(box, there);
    EXPECT_TRUE(out.update(0.0).at_rest) << "nothing has moved";
    for (const auto& [one, place] : {std::pair(&live, here), {&out, there}}) {
        one->move(box, shifted(place, {40.0f, 0.0f, 0.0f}));  // out of the room
        one->update(kUntilAtRest);
    }
    const double without = mean_of(live.map());
    EXPECT_GT(std::abs(without - before), 0.02 * before);
    EXPECT_NEAR(mean_of(out.map()), without, 0.005 * before);
    for (const auto& [one, place] : {std::pair(&live, here), {&out, there}}) {
        one->move(box, shifted(place, shift));
        one->update(kUntilAtRest);
    }
    EXPECT_NEAR(mean_of(out.map()), mean_of(live.map()), 0.005 * before);
}

TEST(LiveLinkScenes, LampsShineFromWhereTheyAreMovedTo)
{
    LiveLinks live(Scene(lit_cube()), {.atlas = {.size = kSize}});
    live.update(kUntilAtRest);
    const double middle = mean_of(live.lumels());
    live.move_lamp("bulb", {.position = Vec3{0.6f, 0.0f, 0.0f}});
    live.update(kUntilAtRest);
    const Map aside = live.lumels();
    // A closed room swallows the same light wherever the lamp is; the wall beside it gets most.
    EXPECT_NEAR(mean_of(aside), middle, 0.1 * middle);
    double brightest = 0.0;
    for (const float one : aside.rgba)
        brightest = std::max(brightest, double(one));
    EXPECT_GT(brightest, 10.0 / (0.4 * 0.4) / 2.0);  // half of I / r² at the foot
}

TEST(LiveLinkScenes, RefuseWhatTheyCannotFollow)
{
    const Scene scene = room();
    const std::uint32_t box = scene.find_instance("box");
    LiveLinks live(scene, link_settings_for(scene));
    Mat4 stretched = scene.instances()[box].transform;
    stretched[0] *= 2.0f;
    const Mat4 nowhere = shifted(scene.instances()[box].transform, {kNoNumber, 0, 0});
    expect_error(ErrorKind::input, {"stretched"}, [&] { live.move(box, stretched); });
    expect_error(ErrorKind::input, {"not finite"}, [&] { live.move(box, nowhere); });
    expect_error(ErrorKind::input, {"instance 99"}, [&] { live.move(99, kIdentity); });
    expect_error(ErrorKind::input, {"no such"}, [&] {
        live.set_lamp("no such", {1.0f, 1.0f, 1.0f});
    });
    expect_error(ErrorKind::input, {"sky"}, [&] { live.set_sky({1, 1, 1}); });
    expect_error(ErrorKind::input, {"no such"}, [&] { live.move_lamp("no such", {}); });
    expect_error(ErrorKind::input, {"red", "0 to 1"}, [&] { live.set_color("red", {2, 0, 0}); });
    const auto made_with = [&](const LiveLinksSettings& settings) {
        LiveLinks(scene, settings).update(0.0);
    };
    LiveLinksSettings settings = link_settings_for(scene);
    settings.movers = {99};
    expect_error(ErrorKind::input, {"99"}, [&] { made_with(settings); });
    settings.movers = {box, box};
    expect_error(ErrorKind::input, {"twice"}, [&] { made_with(settings); });
    settings = link_settings_for(scene);
    settings.rays = 50;
    expect_error(ErrorKind::input, {"50"}, [&] { made_with(settings); });
    settings = link_settings_for(scene);
    settings.residual = 0.0;
    expect_error(ErrorKind::input, {"residual"}, [&] { made_with(settings); });
    LiveLinks lit(Scene(lit_cube()), {.atlas = {.size = kSize}});
    expect_error(ErrorKind::input, {"bulb", "finite"}, [&] {
        lit.move_lamp("bulb", {.position = Vec3{kNoNumber, 0, 0}});
    });
    expect_error(ErrorKind::input, {"bulb", "no length"}, [&] {
        lit.move_lamp("bulb", {.direction = Vec3{0, 0, 0}});
    });
    expect_error(ErrorKind::input, {"bulb"}, [&] { lit.set_lamp("bulb", {-1, 0, 0}); });
}

}  // namespace
}  // namespace lumel::v0
