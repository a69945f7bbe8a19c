#include "rays/cast/ray_scene.h"

#include <cmath>
#include <random>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "../../support/box_lumels.h"

namespace lumel {
namespace {

using support::add_mesh;
using support::add_quad;
using support::Quad;

constexpr float kFar = 1e9f;

/// The unit square in the plane z = 0, seen from +z.
Quad unit_square()
{
    return {};
}

/// A square whose texture is opaque on its left half and clear on its right half.
Scene half_clear_square(AlphaMode mode)
{
    Scene scene;
    scene.textures.push_back({2, 1, {255, 255, 255, 255, 255, 255, 255, 0}});
    add_quad(scene, unit_square());
    scene.materials[0].alpha_mode = mode;
    scene.materials[0].base_color_texture.texture = 0;
    scene.materials[0].base_color_texture.wrap_s = Wrap::clamp;
    return scene;
}

bool hits_from_above(const RayScene& rays, float x, float y, std::uint32_t seed = 0)
{
    RayHit hit;
    return rays.closest({x, y, 1.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, seed, hit);
}

TEST(RayScene, NothingRisesAboveAFloorBesideAWallsReach)
{
    Scene scene;
    add_quad(scene, unit_square());
    add_quad(scene, {.corner = {1, 0, 0}, .edge_u = {0, 1, 0}, .edge_v = {0, 0, 1}});
    const glm::vec3 up(0, 0, 1);
    for (const bool moves : {false, true}) {
        const RayScene rays(scene, std::vector<char>(2, moves ? 1 : 0));
        EXPECT_TRUE(rays.is_clear_above({0.5f, 0.5f, 0.0f}, up, 0.49f, 1e-4f));
        EXPECT_FALSE(rays.is_clear_above({0.5f, 0.5f, 0.0f}, up, 0.51f, 1e-4f));
        EXPECT_TRUE(rays.is_clear_above({0.5f, 0.5f, 0.0f}, up, 0.51f, 1.1f)) << "lower than that";
        // Beside the wall's edge, at 5 cm from it.
        EXPECT_TRUE(rays.is_clear_above({0.96f, -0.03f, 0.0f}, up, 0.049f, 1e-4f));
        EXPECT_FALSE(rays.is_clear_above({0.96f, -0.03f, 0.0f}, up, 0.051f, 1e-4f));
    }
}

TEST(RayScene, FindsBothFacesWhereTwoCoincide)
{
    Scene scene;
    add_quad(scene, unit_square());
    add_quad(scene, {.edge_u = {0, 1, 0}, .edge_v = {1, 0, 0}});
    const RayScene rays(scene);
    int fronts = 0, backs = 0;
    const auto count = [&](const RayHit& hit) {
        ++(hit.front ? fronts : backs);
        return false;
    };
    EXPECT_FALSE(rays.any_at({0.25f, 0.5f, 0.0f}, 1e-5f, {0, 0, -1}, count));
    EXPECT_GE(fronts, 1);
    EXPECT_GE(backs, 1);
    const auto is_back = [](const RayHit& hit) { return !hit.front; };
    EXPECT_TRUE(rays.any_at({0.25f, 0.5f, 0.0f}, 1e-5f, {0, 0, -1}, is_back));
    EXPECT_FALSE(rays.any_at({0.25f, 0.5f, 0.01f}, 1e-5f, {0, 0, -1}, is_back));
}

/// However large a surface is, and wherever: from no side, at no angle.
TEST(RayScene, RaysThatStartAtAHitDoNotHitItsSurfaceAgain)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(-1.0f, 1.0f);
    const auto direction = [&] {
        glm::vec3 v(2.0f);
        while (glm::dot(v, v) > 1.0f || glm::dot(v, v) < 0.01f)
            v = {number(random), number(random), number(random)};
        return glm::normalize(v);
    };
    for (const float size : {0.01f, 1.0f, 100.0f, 10000.0f})
        for (const float away : {0.0f, 10.0f, 1000.0f})
            for (int turn = 0; turn < 32; ++turn) {
                const glm::vec3 u = direction(), v = glm::normalize(glm::cross(u, direction())),
                                middle = away * direction();
                Scene scene;
                add_quad(scene, {.corner = middle - 0.5f * size * (u + v),
                                 .edge_u = size * u,
                                 .edge_v = size * v});
                const RayScene rays(scene);
                for (int k = 0; k < 64; ++k) {
                    const glm::vec3 target =
                        middle + 0.49f * size * (number(random) * u + number(random) * v);
                    const glm::vec3 from = target + 2.0f * size * direction();
                    const glm::vec3 along = glm::normalize(target - from);
                    RayHit hit, again;
                    if (!rays.closest(from, along, 0.0f, kFar, 0, hit))
                        continue;
                    const glm::vec3 normal = hit.front ? hit.normal : -hit.normal;
                    const glm::vec3 start = from + hit.distance * along + hit.ray_offset * normal;
                    glm::vec3 out = direction();
                    if (glm::dot(out, normal) < 0.0f)
                        out = -out;
                    EXPECT_FALSE(rays.closest(start, out, 0.0f, kFar, 0, again))
                        << size << " m, " << away << " m away";
                }
            }
}

TEST(RayScene, RaysStartBySmallSurfacesCloseToThemHoweverLargeTheScene)
{
    Scene scene;
    add_quad(scene, unit_square());
    add_quad(scene, {.corner = {-500, -500, -1}, .edge_u = {1000, 0, 0}, .edge_v = {0, 1000, 0}});
    const RayScene rays(scene);
    RayHit hit;
    ASSERT_TRUE(rays.closest({0.25f, 0.5f, 1.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, 0, hit));
    EXPECT_LT(hit.ray_offset, 1e-4f);
    EXPECT_LT(rays.ray_offset({0.25f, 0.5f, 0.0f}, {0.0f, 0.0f, 1.0f}), 1e-4f);
    ASSERT_TRUE(rays.closest({2.0f, 0.5f, 1.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, 0, hit));
    EXPECT_GT(hit.ray_offset, 1e-3f);
    EXPECT_GT(rays.ray_offset({2.0f, 0.5f, -1.0f}, {0.0f, 0.0f, 1.0f}), 1e-3f);
    EXPECT_GE(rays.ray_offset(), hit.ray_offset);
}

TEST(RayScene, FindsTheNearestTriangleAndSaysWhereOnIt)
{
    Scene scene;
    add_quad(scene, unit_square(), glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -5.0f}));
    add_mesh(scene, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}, {});
    const RayScene rays(scene);
    RayHit hit;
    ASSERT_TRUE(rays.closest({0.25f, 0.5f, 2.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, 0, hit));
    EXPECT_EQ(hit.instance, 1u);
    EXPECT_EQ(hit.primitive, 0u);
    EXPECT_EQ(hit.triangle, 0u);
    EXPECT_FLOAT_EQ(hit.distance, 2.0f);
    EXPECT_NEAR(hit.barycentric.x, 0.25f, 1e-6f);
    EXPECT_NEAR(hit.barycentric.y, 0.5f, 1e-6f);
    EXPECT_TRUE(hit.front);
    EXPECT_NEAR(hit.normal.z, 1.0f, 1e-6f);

    ASSERT_TRUE(rays.closest({0.75f, 0.5f, 2.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, 0, hit));
    EXPECT_EQ(hit.instance, 0u);
    EXPECT_FLOAT_EQ(hit.distance, 7.0f);
    EXPECT_FALSE(rays.closest({1.25f, 0.5f, 2.0f}, {0.0f, 0.0f, -1.0f}, 0.0f, kFar, 0, hit));
}

TEST(RayScene, RespectsTheNearAndFarEndOfARay)
{
    Scene scene;
    add_quad(scene, unit_square());
    const RayScene rays(scene);
    RayHit hit;
    const glm::vec3 origin(0.3f, 0.4f, 1.0f), down(0.0f, 0.0f, -1.0f);
    EXPECT_TRUE(rays.closest(origin, down, 0.9f, 1.1f, 0, hit));
    EXPECT_FALSE(rays.closest(origin, down, 1.1f, kFar, 0, hit));
    EXPECT_FALSE(rays.closest(origin, down, 0.0f, 0.9f, 0, hit));
}

TEST(RayScene, SeesOutWhereNothingIsInTheWayHoweverFar)
{
    Scene scene;
    add_quad(scene, unit_square(), glm::translate(glm::mat4(1.0f), {0.0f, 0.0f, -1e6f}));
    const RayScene rays(scene);
    EXPECT_FALSE(rays.sees_out({0.3f, 0.4f, 1.0f}, {0.0f, 0.0f, -1.0f}, 0));
    EXPECT_TRUE(rays.sees_out({0.3f, 0.4f, 1.0f}, {0.0f, 0.0f, 1.0f}, 0));
    EXPECT_TRUE(rays.sees_out({1.3f, 0.4f, 1.0f}, {0.0f, 0.0f, -1.0f}, 0));
}

TEST(RayScene, TellsFrontFromBack)
{
    Scene scene;
    add_quad(scene, unit_square());
    const RayScene rays(scene);
    RayHit hit;
    ASSERT_TRUE(rays.closest({0.3f, 0.4f, -1.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, kFar, 0, hit));
    EXPECT_FALSE(hit.front);
    EXPECT_NEAR(hit.normal.z, 1.0f, 1e-6f) << "the normal stays with the front";
}

TEST(RayScene, KeepsTheFrontOfMirroredAndTurnedInstances)
{
    const glm::mat4 mirror_x = glm::scale(glm::mat4(1.0f), {-2.0f, 1.0f, 1.0f});
    const glm::mat4 mirror_z = glm::scale(glm::mat4(1.0f), {1.0f, 1.0f, -1.0f});
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), support::kPi, {1.0f, 0.0f, 0.0f});
    const struct {
        glm::mat4 transform;
        float normal_z;  // where the mesh's +z has gone
    } cases[] = {{mirror_x, 1.0f}, {mirror_z, -1.0f}, {turn, -1.0f}, {turn * mirror_z, 1.0f}};
    for (const auto& placed : cases) {
        Scene scene;
        add_quad(scene, unit_square(), placed.transform);
        const RayScene rays(scene);
        const glm::vec3 middle(placed.transform * glm::vec4(0.4f, 0.5f, 0.0f, 1.0f));
        RayHit hit;
        ASSERT_TRUE(rays.closest(middle + glm::vec3(0.0f, 0.0f, 1.0f), {0.0f, 0.0f, -1.0f}, 0.0f,
                                 kFar, 0, hit));
        EXPECT_NEAR(hit.normal.z, placed.normal_z, 1e-6f);
        EXPECT_EQ(hit.front, placed.normal_z > 0.0f);
    }
}

TEST(RayScene, SeesUnlessSomethingLiesBetween)
{
    Scene scene;
    add_quad(scene, unit_square());
    const RayScene rays(scene);
    const glm::vec3 above(0.5f, 0.5f, 1.0f), below(0.5f, 0.5f, -1.0f), aside(3.0f, 0.5f, 1.0f);
    EXPECT_FALSE(rays.sees(above, below, 1e-4f, 0));
    EXPECT_FALSE(rays.sees(below, above, 1e-4f, 0)) << "backs block as well";
    EXPECT_TRUE(rays.sees(above, aside, 1e-4f, 0));
    EXPECT_TRUE(rays.sees(above, {0.5f, 0.5f, 0.0f}, 1e-4f, 0)) << "ends are shortened";
    EXPECT_FALSE(rays.sees(above, {0.5f, 0.5f, -0.01f}, 1e-4f, 0));
}

TEST(RayScene, CutsOutWhatMaskSaysExactly)
{
    const Scene scene = half_clear_square(AlphaMode::mask);
    const RayScene rays(scene);
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        EXPECT_TRUE(hits_from_above(rays, 0.1f, 0.4f, seed));
        EXPECT_FALSE(hits_from_above(rays, 0.9f, 0.4f, seed));
        EXPECT_FALSE(rays.sees({0.1f, 0.4f, 1.0f}, {0.1f, 0.4f, -1.0f}, 0.0f, seed));
        EXPECT_TRUE(rays.sees({0.9f, 0.4f, 1.0f}, {0.9f, 0.4f, -1.0f}, 0.0f, seed));
    }
}

TEST(RayScene, IgnoresAlphaOfOpaqueSurfaces)
{
    const Scene scene = half_clear_square(AlphaMode::opaque);
    EXPECT_TRUE(hits_from_above(RayScene(scene), 0.9f, 0.4f));
}

TEST(RayScene, HitsBlendedSurfacesAsOftenAsAlphaSays)
{
    Scene scene;
    add_quad(scene, unit_square());
    scene.materials[0].alpha_mode = AlphaMode::blend;
    scene.materials[0].base_color.a = 0.3f;
    const RayScene rays(scene);
    constexpr int kQueries = 20000;
    int hits = 0, seen = 0;
    for (std::uint32_t seed = 0; seed < kQueries; ++seed) {
        const bool hit = hits_from_above(rays, 0.4f, 0.3f, seed);
        ASSERT_EQ(hit, hits_from_above(rays, 0.4f, 0.3f, seed)) << "one seed, one answer";
        hits += hit;
        seen += rays.sees({0.4f, 0.3f, 1.0f}, {0.4f, 0.3f, -1.0f}, 0.0f, seed);
    }
    const double deviation = std::sqrt(0.3 * 0.7 * kQueries);
    EXPECT_NEAR(hits, 0.3 * kQueries, 4.0 * deviation);
    EXPECT_NEAR(seen, 0.7 * kQueries, 4.0 * deviation);
}

TEST(RayScene, GlassTintsWhatPasses)
{
    support::Quad pane;
    pane.albedo = {1.0f, 0.5f, 0.25f};
    support::Quad wall = pane, beyond = pane;
    wall.corner.z = -1.0f;
    beyond.corner.z = -2.0f;
    Scene scene = support::make_quads({pane, wall, beyond}).scene;
    scene.materials[0].transmission = scene.materials[2].transmission = 1.0f;
    const RayScene rays(scene);
    const glm::vec3 above(0.4f, 0.3f, 1.0f), down(0.0f, 0.0f, -1.0f);
    EXPECT_EQ(rays.transmittance(above, {0.4f, 0.3f, -0.5f}, 0.0f, 1), pane.albedo);
    EXPECT_EQ(rays.transmittance(above, {0.4f, 0.3f, 0.5f}, 0.0f, 1), glm::vec3(1.0f));
    EXPECT_EQ(rays.transmittance_out(above, down, 1), glm::vec3(0.0f)) << "there is a wall";

    RayHit hit;
    ASSERT_TRUE(rays.closest(above, down, 0.0f, kFar, 1, hit));
    EXPECT_FLOAT_EQ(hit.distance, 2.0f);
    EXPECT_EQ(hit.tint, pane.albedo) << "glass behind the wall has no effect";

    scene.materials[1].transmission = 1.0f;
    const glm::vec3 thrice = pane.albedo * pane.albedo * pane.albedo;
    const RayScene all_glass(scene);
    EXPECT_EQ(all_glass.transmittance_out(above, down, 1), thrice);
    EXPECT_FALSE(all_glass.closest(above, down, 0.0f, kFar, 1, hit));
    EXPECT_EQ(hit.tint, thrice);
}

/// Triangles of all sizes in a unit cube, some cut out, some blended, some of glass: rays pass
/// many.
Scene soup(std::uint32_t triangles)
{
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number;
    const auto point = [&] { return glm::vec3(number(random), number(random), number(random)); };
    Scene scene = half_clear_square(AlphaMode::mask);
    for (int kind = 0; kind < 4; ++kind) {
        std::vector<glm::vec3> positions;
        std::vector<std::uint32_t> corners;
        for (std::uint32_t t = 0; t < triangles; ++t) {
            const glm::vec3 at = point();
            for (int k = 0; k < 3; ++k) {
                corners.push_back(std::uint32_t(positions.size()));
                positions.push_back(at + 0.2f * number(random) * (point() - 0.5f));
            }
        }
        Material material = scene.materials[0];
        if (kind != 0)
            material = Material{};
        if (kind == 1) {
            material.alpha_mode = AlphaMode::blend;
            material.base_color.a = 0.3f;
        } else if (kind == 2) {
            material.transmission = 1.0f;
            material.base_color = {1.0f, 0.5f, 0.25f, 1.0f};
        }
        add_mesh(scene, positions, corners, material);
        for (auto& texcoords : scene.meshes.back().primitives[0].texcoords)
            for (std::size_t v = 0; v < positions.size(); ++v)
                texcoords.emplace_back(number(random), number(random));
    }
    return scene;
}

/// Rays from everywhere to everywhere, some empty, in packets of any size.
void expect_as_alone(const RayScene& rays)
{
    std::mt19937 random(2);
    std::uniform_real_distribution<float> number(-0.1f, 1.1f);
    const auto point = [&] { return glm::vec3(number(random), number(random), number(random)); };
    std::size_t hit = 0, missed = 0, tinted = 0;
    for (std::size_t count = 0; count < 200; ++count) {
        std::vector<RaySpan> packet;
        for (std::size_t n = 0; n < count; ++n) {
            packet.push_back(ray_between(point(), point(), 0.0f, std::uint32_t(random())));
            if (n % 7 == 3)
                packet.back().far = -1.0f;  // empty
        }
        std::vector<RayHit> hits(count);
        rays.closest(packet, hits);
        std::vector<glm::vec3> transmittance(count);
        rays.transmittance(packet, transmittance);
        for (std::size_t n = 0; n < count; ++n) {
            ASSERT_EQ(transmittance[n], rays.transmittance(packet[n])) << n << " of " << count;
            RayHit alone;
            const bool any = rays.closest(packet[n], alone);
            ASSERT_EQ(std::isfinite(hits[n].distance), any) << n << " of " << count;
            EXPECT_EQ(hits[n].tint, alone.tint);
            (any ? hit : missed) += 1;
            tinted += alone.tint != glm::vec3(1.0f);
            if (!any)
                continue;
            EXPECT_EQ(hits[n].instance, alone.instance);
            EXPECT_EQ(hits[n].primitive, alone.primitive);
            EXPECT_EQ(hits[n].triangle, alone.triangle);
            EXPECT_EQ(hits[n].front, alone.front);
            EXPECT_NEAR(hits[n].distance, alone.distance, 1e-5f);
            EXPECT_LT(glm::distance(hits[n].normal, alone.normal), 1e-4f);
            EXPECT_LT(glm::distance(hits[n].barycentric, alone.barycentric), 1e-3f);
            EXPECT_NEAR(hits[n].ray_offset, alone.ray_offset, 1e-8f);
        }
    }
    EXPECT_GT(hit, 2000u);
    EXPECT_GT(missed, 500u);
    EXPECT_GT(tinted, 1000u);
}

TEST(RayScene, RaysOfAPacketMeetWhatTheyMeetAlone)
{
    const Scene scene = soup(200);
    expect_as_alone(RayScene(scene));
    expect_as_alone(RayScene(scene, {0, 0, 1, 0, 1}));
}

TEST(RayScene, KnowsItsBounds)
{
    Scene scene;
    EXPECT_EQ(RayScene(scene).low(), glm::vec3(0.0f));
    add_quad(scene, unit_square(), glm::translate(glm::mat4(1.0f), {2.0f, 3.0f, 4.0f}));
    RayScene rays(scene);
    rays = RayScene(scene);
    EXPECT_EQ(rays.low(), glm::vec3(2.0f, 3.0f, 4.0f));
    EXPECT_EQ(rays.high(), glm::vec3(3.0f, 4.0f, 4.0f));
}

/// A room with two boxes, coloured panes of glass and a veil in it; all but the room may move.
struct Furnished {
    Scene scene;
    std::vector<std::uint32_t> movable;
};

Furnished furnished_room()
{
    Furnished room;
    for (const Quad& wall : support::box_walls(glm::vec3(0.0f), glm::vec3(4.0f), true))
        add_quad(room.scene, wall);
    const auto first = std::uint32_t(room.scene.instances.size());
    for (int box = 0; box < 2; ++box)
        add_mesh(room.scene, {{0, 0, 0}, {0.7f, 0, 0}, {0, 0.8f, 0}, {0, 0, 0.9f}},
                 {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, {});
    for (const glm::vec3& color : {glm::vec3(0.9f, 0.5f, 0.3f), glm::vec3(0.7f, 0.8f, 0.3f)}) {
        Quad pane;
        pane.albedo = color;
        add_quad(room.scene, pane);
        room.scene.materials.back().transmission = 1.0f;
    }
    add_quad(room.scene, unit_square());
    room.scene.materials.back().alpha_mode = AlphaMode::blend;
    room.scene.materials.back().base_color.a = 0.5f;
    for (std::uint32_t i = first; i < room.scene.instances.size(); ++i)
        room.movable.push_back(i);
    return room;
}

/// Anywhere in that room, turned anyhow.
glm::mat4 random_place(std::mt19937& random)
{
    std::uniform_real_distribution<float> place(0.5f, 3.0f), part(-1.0f, 1.0f);
    const glm::vec3 to(place(random), place(random), place(random));
    const glm::vec3 axis(part(random), part(random), 1.5f);
    return glm::rotate(glm::translate(glm::mat4(1.0f), to), 3.0f * part(random), axis);
}

TEST(RayScene, WhatHasMovedIsMetAsInANewSceneBitForBit)
{
    constexpr int kMoves = 20, kRays = 2000;
    Furnished room = furnished_room();
    std::vector<char> movers(room.scene.instances.size(), 0);
    std::mt19937 random(7);
    for (const std::uint32_t i : room.movable) {
        movers[i] = 1;
        room.scene.instances[i].transform = random_place(random);  // none lies in a wall's plane
    }
    RayScene moved(room.scene, movers);
    std::uniform_real_distribution<float> inside(0.1f, 3.9f);
    const auto point = [&] { return glm::vec3(inside(random), inside(random), inside(random)); };
    int on_movers = 0;
    for (int move = 0; move < kMoves; ++move) {
        std::vector<std::uint32_t> chosen{room.movable[random() % room.movable.size()],
                                          room.movable[random() % room.movable.size()]};
        for (const std::uint32_t i : chosen)
            room.scene.instances[i].transform = random_place(random);
        moved.place(chosen);
        const RayScene fresh(room.scene);
        EXPECT_EQ(moved.low(), fresh.low());
        EXPECT_EQ(moved.high(), fresh.high());
        for (std::uint32_t ray = 0; ray < kRays; ++ray) {
            const glm::vec3 from = point(), to = point(), toward = glm::normalize(to - from);
            ASSERT_EQ(moved.transmittance(from, to, 1e-4f, ray),
                      fresh.transmittance(from, to, 1e-4f, ray));
            RayHit a, b;
            ASSERT_EQ(moved.closest(from, toward, 0.0f, kFar, ray, a),
                      fresh.closest(from, toward, 0.0f, kFar, ray, b));
            EXPECT_EQ(a.instance, b.instance);
            EXPECT_EQ(a.triangle, b.triangle);
            EXPECT_EQ(a.barycentric, b.barycentric);
            EXPECT_EQ(a.distance, b.distance);
            EXPECT_EQ(a.normal, b.normal);
            EXPECT_EQ(a.front, b.front);
            EXPECT_EQ(a.tint, b.tint);
            on_movers += movers[a.instance];
        }
    }
    EXPECT_GT(on_movers, kMoves * kRays / 20);
}

}  // namespace
}  // namespace lumel
