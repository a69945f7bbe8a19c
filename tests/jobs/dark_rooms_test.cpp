// Light of a room stays in it: the next room gets what passes through the door, and nothing else.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "../support/box_lumels.h"
#include "../support/lamps.h"
#include "links/trace/links.h"
#include "solved.h"
#include "truth/reference.h"

namespace lumel {
namespace {

// Odd sizes: no edge of a wall lies on the edge of a texel [m].
constexpr float kWide = 3.07f, kHigh = 2.53f, kDeep = 3.11f, kSecond = 3.083f;
constexpr glm::vec3 kGrey(0.7f);

struct Rooms {
    float wall = 0.15f;     ///< thickness [m]; 0: one double-sided plane
    float below = 0.4f;     ///< the lamp hangs this far below the ceiling [m]
    bool has_door = false;  ///< 0.8 × 2 m
    float glow = 0.0f;      ///< emission of the walls [lm/m²]
    float density = 5.0f;   ///< [texels/m]
};

/// Floor, ceiling and outer walls pass through both rooms, and lumels lie across the wall's foot.
Scene two_rooms(const Rooms& rooms)
{
    Scene scene;
    const auto add = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        support::add_quad(scene, {.corner = corner,
                                  .edge_u = u,
                                  .edge_v = v,
                                  .albedo = kGrey,
                                  .emission = glm::vec3(rooms.glow),
                                  .double_sided = true});
    };
    const glm::vec3 x(kWide + rooms.wall + kSecond, 0.0f, 0.0f), y(0.0f, kHigh, 0.0f),
        z(0.0f, 0.0f, kDeep), none(0.0f);
    add(none, z, x);
    add(y, x, z);
    add(none, x, y);
    add(z, y, x);
    add(none, y, z);
    add(x, z, y);
    constexpr float kDoorFrom = 1.03f, kDoorTo = 1.83f, kDoorHigh = 2.0f;
    const auto add_wall = [&](float at) {
        const glm::vec3 foot(at, 0.0f, 0.0f);
        if (!rooms.has_door) {
            add(foot, z, y);
            return;
        }
        add(foot, {0.0f, 0.0f, kDoorFrom}, y);
        add(foot + glm::vec3(0.0f, 0.0f, kDoorTo), {0.0f, 0.0f, kDeep - kDoorTo}, y);
        add(foot + glm::vec3(0.0f, kDoorHigh, kDoorFrom), {0.0f, 0.0f, kDoorTo - kDoorFrom},
            {0.0f, kHigh - kDoorHigh, 0.0f});
    };
    add_wall(kWide);
    if (rooms.wall > 0.0f) {
        add_wall(kWide + rooms.wall);
        if (rooms.has_door) {
            const glm::vec3 through(rooms.wall, 0.0f, 0.0f);
            for (const float side : {kDoorFrom, kDoorTo})
                add({kWide, 0.0f, side}, through, {0.0f, kDoorHigh, 0.0f});
            add({kWide, kDoorHigh, kDoorFrom}, through, {0.0f, 0.0f, kDoorTo - kDoorFrom});
        }
    }
    if (rooms.glow > 0.0f)
        return scene;
    support::add_quad(scene, {.corner = {1.31f, kHigh - rooms.below, 1.2f},
                              .edge_u = {0.6f, 0.0f, 0.0f},
                              .edge_v = {0.0f, 0.0f, 0.6f},
                              .albedo = kGrey,
                              .emission = glm::vec3(3000.0f),
                              .double_sided = true});
    return scene;
}

/// Lumels that lie wholly in the second room.
std::vector<std::size_t> in_second_room(const SolveScene& world, const Rooms& rooms)
{
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < world.lumels.lumels.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        const float from = kWide + rooms.wall;
        const bool is_wall = std::abs(lumel.normal.x) > 0.5f;
        const float x = lumel.position.x - (is_wall ? 0.0f : lumel.size);
        const bool faces_it = !is_wall || lumel.position.x > from + 1e-3f || lumel.normal.x > 0.0f;
        if (x > from - 1e-3f && faces_it && !(lumel.flags & kLumelBuried))
            found.push_back(i);
    }
    return found;
}

support::Solved solve(const SolveScene& world, double error)
{
    SolverOptions options;
    options.method = support::method("links");
    options.target_error = 0.0;
    options.target_quality.eye_error = error;
    return support::solve_scene(world, options);
}

class ClosedPair : public testing::TestWithParam<Rooms> {};

INSTANTIATE_TEST_SUITE_P(
    Walls, ClosedPair,
    testing::Values(Rooms{.wall = 0.15f}, Rooms{.wall = 0.1f, .density = 20.0f},
                    Rooms{.wall = 0.05f}, Rooms{.wall = 0.05f, .density = 2.0f},
                    Rooms{.wall = 0.01f, .density = 2.0f}, Rooms{.wall = 0.0f, .density = 2.0f},
                    Rooms{.wall = 0.0f, .density = 20.0f}),
    [](const auto& tested) {
        return std::to_string(int(std::lround(100.0f * tested.param.wall))) + "cm_at_" +
               std::to_string(int(tested.param.density));
    });

TEST_P(ClosedPair, IsExactlyDarkBehindTheWall)
{
    const Rooms rooms = GetParam();
    const SolveScene world(two_rooms(rooms), {.texels_per_metre = rooms.density});
    const std::vector<glm::vec3> light = solve(world, 0.1).irradiance;
    const std::vector<std::size_t> dark = in_second_room(world, rooms);
    EXPECT_GT(dark.size(), 50u);
    std::size_t lit = 0;
    for (const std::size_t i : dark)
        lit += light[i] != glm::vec3(0.0f);
    EXPECT_EQ(lit, 0u) << "of " << dark.size() << " lumels";
    EXPECT_TRUE(std::any_of(light.begin(), light.end(),
                            [](const glm::vec3& one) { return one.g > 50.0f; }));
}

/// A lamp in each room: cells of lumels that the wall cuts keep the light of both apart.
TEST_P(ClosedPair, KeepsTheLightOfALampInItsRoom)
{
    const Rooms rooms = GetParam();
    Scene scene = two_rooms(rooms);
    const std::size_t first = scene.instances.size() - 1;
    support::add_quad(scene, {.corner = {kWide + rooms.wall + 1.3f, kHigh - 0.4f, 1.2f},
                              .edge_u = {0.6f, 0.0f, 0.0f},
                              .edge_v = {0.0f, 0.0f, 0.6f},
                              .albedo = kGrey,
                              .emission = glm::vec3(3000.0f),
                              .double_sided = true});
    scene.instances[first].name = "first";
    scene.instances.back().name = "second";
    const SolveScene world(std::move(scene), {.texels_per_metre = rooms.density});
    SolverOptions options;
    options.target_error = 0.1;
    options.target_quality = {};
    LinkRadiosity solver(world, LinksOptions{.per_lamp = true}, options.limits());
    ASSERT_TRUE(lumel::solve(solver, options));
    ASSERT_EQ(solver.lamps()->all.size(), 2u);
    const auto lamps = solver.light_of_lamps()->lamps;
    const std::size_t of_first = solver.lamps()->all[0].name == "first" ? 0 : 1;
    std::size_t lit = 0, count = 0;
    for (const std::size_t i : in_second_room(world, rooms)) {
        lit += lamps[of_first].irradiance[i] != glm::vec3(0.0f);
        count += lamps[1 - of_first].irradiance[i] != glm::vec3(0.0f);
    }
    EXPECT_EQ(lit, 0u);
    EXPECT_GT(count, 50u);
}

/// Lumels of the floor that are mostly in the dark room show the light of their sliver in the lit
/// one, too.
TEST(LumelAcrossAWall, HasTheMeanLightOfItsArea)
{
    const Rooms rooms{.wall = 0.0f, .density = 5.2f};
    const SolveScene world(two_rooms(rooms), {.texels_per_metre = rooms.density});
    const std::vector<glm::vec3> light = solve(world, 0.1).irradiance;
    const std::vector<glm::vec3> truth = reference_irradiance(
        world.scene, world.rays, world.lumels, {.samples_per_lumel = 512, .seed = 11});
    double found = 0.0, wanted = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        if (lumel.normal.y > 0.5f && std::abs(lumel.position.x - kWide) < 0.5f * lumel.size) {
            found += double(lumel.area) * double(light[i].g);
            wanted += double(lumel.area) * double(truth[i].g);
        }
    }
    EXPECT_GT(wanted, 0.0);
    EXPECT_NEAR(found / wanted, 1.0, 0.02);
}

/// What is not known must not count as dark: few rays leave some parts of cut lumels without any,
/// and of walls that shine, cells see parts that the middle wall hides from others.
TEST(TwoRooms, GlowAsAFurnaceDoesWithFewRays)
{
    const float limit = 1.0f / (1.0f - kGrey.r);  // E/(1 - ρ)
    const Rooms rooms{.wall = 0.05f, .glow = 1.0f, .density = 4.0f};
    const SolveScene world(two_rooms(rooms), {.texels_per_metre = rooms.density});
    SolverOptions options;
    options.method = LinksOptions{.even_rays = 24};
    options.target_error = 0.0;
    const std::vector<glm::vec3> light = support::solve_scene(world, options).irradiance;
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = world.lumels.lumels[i];
        if (lumel.flags & (kLumelBuried | kLumelBack))
            continue;
        sum += double(lumel.area) * double(light[i].g);
        area += double(lumel.area);
    }
    EXPECT_NEAR(sum / area, limit, 0.01 * limit);
}

/// Light in the gap above a lamp is a hundred times that of the room. Lumels across the lamp's edge
/// hold both.
TEST(LampBelowACeiling, DoesNotLightTheNextRoomByItsGap)
{
    for (const float gap : {0.005f, 0.02f}) {
        const Rooms rooms{.below = gap, .has_door = true};
        const SolveScene world(two_rooms(rooms), {.texels_per_metre = rooms.density});
        const std::vector<glm::vec3> light = solve(world, 0.01).irradiance;
        const std::vector<glm::vec3> truth = reference_irradiance(
            world.scene, world.rays, world.lumels, {.samples_per_lumel = 1024, .seed = 11});
        double found = 0.0, wanted = 0.0;
        for (const std::size_t i : in_second_room(world, rooms)) {
            found += double(world.lumels.lumels[i].area) * double(light[i].g);
            wanted += double(world.lumels.lumels[i].area) * double(truth[i].g);
        }
        EXPECT_NEAR(found / wanted, 1.0, 0.015) << gap << " m";
    }
}

/// A cube of 1 m whose front is a blind in the sun, of slats that overlap: all light in it comes
/// from their lower sides, which the slats below light unevenly.
Scene room_behind_a_blind()
{
    constexpr int kSlats = 40;
    constexpr float kPitch = 1.0f / float(kSlats);
    constexpr glm::vec3 kX(1.0f, 0.0f, 0.0f), kY(0.0f, 1.0f, 0.0f), kZ(0.0f, 0.0f, 1.0f);
    Scene scene;
    const auto add = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
        support::add_quad(scene, {.corner = corner, .edge_u = u, .edge_v = v, .albedo = kGrey});
    };
    add({}, kZ, kX);
    add(kY, kX, kZ);
    add(kZ, kY, kX);
    add({}, kY, kZ);
    add(kX, kZ, kY);
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (int k = 0; k < kSlats; ++k) {
        const glm::vec3 edge = kPitch * float(k) * kY;
        const glm::vec3 across(0.0f, 0.56f * kPitch, 0.8f * kPitch);
        const auto first = std::uint32_t(positions.size());
        for (const glm::vec3& corner : {edge - across, edge - across + kX, edge + kX, edge})
            positions.push_back(corner);
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            indices.push_back(first + corner);
    }
    Material slat;
    slat.base_color = glm::vec4(0.85f, 0.85f, 0.85f, 1.0f);
    slat.double_sided = true;
    support::add_mesh(scene, positions, indices, slat);
    scene.lights.push_back(
        support::make_lamp(PunctualLight::Kind::directional, 1e5f, {}, {0.0f, -0.57f, 0.82f}));
    return scene;
}

/// Two slats then share a texel.
TEST(SlatsThinnerThanATexel, LightTheRoomBehindThem)
{
    const SolveScene world(room_behind_a_blind(), {.texels_per_metre = 31.0f});
    const std::vector<glm::vec3> light = solve(world, 0.01).irradiance;
    const std::vector<glm::vec3> truth = reference_irradiance(
        world.scene, world.rays, world.lumels, {.samples_per_lumel = 256, .seed = 11});
    for (const glm::vec3& facing : {glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.0f, 0.0f, -1.0f)}) {
        double found = 0.0, wanted = 0.0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            const Lumel& lumel = world.lumels.lumels[i];
            if (glm::dot(lumel.normal, facing) < 0.99f || lumel.flags & kLumelBuried)
                continue;
            found += double(lumel.area) * double(light[i].g);
            wanted += double(lumel.area) * double(truth[i].g);
        }
        EXPECT_GT(wanted, 0.0);
        EXPECT_NEAR(found / wanted, 1.0, 0.015) << facing.y << ", " << facing.z;
    }
}

}  // namespace
}  // namespace lumel
