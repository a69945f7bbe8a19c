// Which lumels lie under or inside other geometry.

#include <algorithm>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "atlas/near/buried.h"

namespace lumel {
namespace {

using namespace support;

/// 8 × 8 lumels of 1 m, facing up; lumel (x, z) has index 8 x + z.
Quad floor_8x8()
{
    Quad floor;
    floor.edge_u = {0, 0, 8};
    floor.edge_v = {8, 0, 0};
    floor.res_u = floor.res_v = 8;
    return floor;
}

enum Faces { closed, bottomless, topless };

/// The walls of a box, each one lumel.
void add_box(std::vector<Quad>& quads, const glm::vec3& low, const glm::vec3& high, Faces faces,
             bool inward = false, const Quad& look = {})
{
    const auto walls = box_walls(low, high, inward, look);
    for (std::size_t side = 0; side < walls.size(); ++side)
        if (!(faces == bottomless && side == 2) && !(faces == topless && side == 3))
            quads.push_back(walls[side]);
}

/// Marks the lumels that are buried, and returns them.
std::vector<bool> buried(HandMade made)
{
    mark_buried(made.scene, RayScene(made.scene), {}, made.lumels);
    std::vector<bool> result;
    for (const Lumel& lumel : made.lumels.lumels)
        result.push_back((lumel.flags & kLumelBuried) != 0);
    return result;
}

std::vector<bool> buried(const std::vector<Quad>& quads)
{
    return buried(make_quads(quads));
}

/// Expects exactly the floor lumels x0 … x1 - 1, z0 … z1 - 1 to be buried.
void expect_buried_floor(const std::vector<bool>& result, int x0, int x1, int z0, int z1)
{
    for (int x = 0; x < 8; ++x)
        for (int z = 0; z < 8; ++z)
            EXPECT_EQ(bool(result[std::size_t(8 * x + z)]), x >= x0 && x < x1 && z >= z0 && z < z1)
                << x << " " << z;
}

TEST(Buried, AnOpenFloorIsNot)
{
    expect_buried_floor(buried(std::vector<Quad>{floor_8x8()}), 0, 0, 0, 0);
}

TEST(Buried, TheFloorUnderABlockIsWithOrWithoutABottom)
{
    for (const Faces faces : {closed, bottomless}) {
        std::vector<Quad> quads{floor_8x8()};
        add_box(quads, {2, 0, 3}, {5, 2, 6}, faces);
        expect_buried_floor(buried(quads), 2, 5, 3, 6);
    }
}

TEST(Buried, TheFloorUnderABlockThatSinksInOrHoversByAHairIs)
{
    for (const float bottom : {-0.5f, -1e-5f, 1e-5f, 1e-3f}) {
        std::vector<Quad> quads{floor_8x8()};
        add_box(quads, {2, bottom, 3}, {5, 2, 6}, closed);
        const std::vector<bool> result = buried(quads);
        EXPECT_TRUE(result[8 * 3 + 4]) << bottom;
        EXPECT_FALSE(result[8 * 1 + 4]) << bottom;
    }
}

/// As steps of a stair, or a wall around a window: rays from below meet the front of the next block
/// where they meet the back of their own.
TEST(Buried, TheFloorUnderBlocksThatTouchIs)
{
    for (const float bottom : {-0.5f, 0.0f, 1e-3f}) {
        std::vector<Quad> quads{floor_8x8()};
        for (int step = 0; step < 5; ++step) {
            const auto x = float(step + 1);
            add_box(quads, {x, bottom, 1}, {x + 1.0f, 0.4f * x, 7}, closed);
        }
        expect_buried_floor(buried(quads), 1, 6, 1, 7);
    }
}

/// Its faces coincide with a floor and a wall behind which nothing is.
TEST(Buried, TheFloorUnderABlockInTheCornerOfARoomOfSheetsIs)
{
    std::vector<Quad> quads{floor_8x8()};
    add_box(quads, {0, 0, 0}, {8, 3, 8}, bottomless, true);
    add_box(quads, {0, 0, 2}, {3, 2, 6}, closed);
    expect_buried_floor(buried(quads), 0, 3, 2, 6);
}

/// It lies 0.4 mm above a ground of 100 m: above the start of rays that tell what is buried, below
/// that of rays from cell to cell.
TEST(Buried, LumelsPartlyUnderAThinMarkingAreNot)
{
    for (const float from : {2.1f, 2.3f, 2.6f, 2.9f}) {
        Quad ground = floor_8x8();
        ground.edge_u.z = ground.edge_v.x = 100.0f;
        ground.res_u = ground.res_v = 100;
        const Quad marking{
            .corner = {0.0f, 4e-4f, from}, .edge_u = {0, 0, 0.5f}, .edge_v = {100, 0, 0}};
        for (const bool is : buried({ground, marking}))
            EXPECT_FALSE(is) << from;
    }
}

/// Their faces coincide like those of blocks that touch.
TEST(Buried, TheFloorAmongWallsOfTwoFacesEachIsNot)
{
    std::vector<Quad> quads{floor_8x8()};
    for (const bool inward : {false, true})
        add_box(quads, {0, 0, 0}, {8, 3, 8}, closed, inward);
    expect_buried_floor(buried(quads), 0, 0, 0, 0);
}

TEST(Buried, ALumelPartlyUnderABlockIsNot)
{
    std::vector<Quad> quads{floor_8x8()};
    add_box(quads, {2.0f, 0, 3}, {4.7f, 2, 6}, bottomless);
    expect_buried_floor(buried(quads), 2, 4, 3, 6);
}

TEST(Buried, TheInsideOfAnOpenBoxIsNot)
{
    std::vector<Quad> quads{floor_8x8()};
    add_box(quads, {2, 0, 3}, {5, 2, 6}, topless);
    add_box(quads, {2, 0, 3}, {5, 2, 6}, topless, true);
    EXPECT_FALSE(buried(quads)[8 * 3 + 4]);
}

TEST(Buried, TheDarkInsideOfASealedRoomyBoxIsNot)
{
    std::vector<Quad> quads;
    add_box(quads, {0, 0, 0}, {2, 2, 2}, closed);
    add_box(quads, {0.1f, 0.1f, 0.1f}, {1.9f, 1.9f, 1.9f}, closed, true);
    for (const bool is : buried(quads))
        EXPECT_FALSE(is);
}

/// Some of its rays meet the floor's front, which stands in the wall as well.
TEST(Buried, ACeilingInsideATallWallIs)
{
    Quad ceiling = floor_8x8();
    ceiling.corner.y = 17.0f;
    std::swap(ceiling.edge_u, ceiling.edge_v);
    std::vector<Quad> quads{ceiling, floor_8x8()};
    add_box(quads, {2, -1, 2}, {6, 20, 6}, closed);
    expect_buried_floor(buried(quads), 2, 6, 2, 6);
}

TEST(Buried, AWallInsideAWallIs)
{
    std::vector<Quad> quads;
    Quad hidden;  // faces +z, in the middle of a thick wall
    hidden.corner = {1, 1, 0};
    quads.push_back(hidden);
    add_box(quads, {0, 0, -0.2f}, {3, 3, 0.2f}, closed);
    const std::vector<bool> result = buried(quads);
    EXPECT_TRUE(result[0]);
    for (std::size_t i = 1; i < result.size(); ++i)
        EXPECT_FALSE(result[i]) << i;
}

/// It has a front, a top and ends, but neither back nor bottom: wall and floor in it face each
/// other. The lowest row, which sees much of the floor, is not seen from the room.
TEST(Buried, AWallBehindASkirtingBoardIs)
{
    constexpr int kColumns = 32, kRows = 8;
    constexpr float kWidth = 8.0f, kRow = 0.25f, kTop = 0.6f, kThick = 0.1f;
    Quad wall, floor;
    wall.edge_u = {kWidth, 0, 0};
    wall.edge_v = {0, kRow * kRows, 0};
    wall.res_u = kColumns;
    wall.res_v = kRows;
    floor.edge_u = {0, 0, kWidth};
    floor.edge_v = {kWidth, 0, 0};
    std::vector<Quad> quads{wall, floor};
    const auto sides = box_walls({0, 0, 0}, {kWidth, kTop, kThick}, false, {});
    for (const std::size_t side : {0u, 1u, 3u, 5u})
        quads.push_back(sides[side]);
    HandMade made = make_quads(quads);
    const std::vector<float> open = mark_buried(made.scene, RayScene(made.scene), {}, made.lumels);
    for (int row = 1; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
            EXPECT_NEAR(open[std::size_t(kColumns * row + column)],
                        std::clamp((float(row + 1) * kRow - kTop) / kRow, 0.0f, 1.0f), 0.04f)
                << row << " " << column;
}

TEST(Buried, TheBottomOfAThinSlitIsNot)
{
    // Two blocks on the floor, 5 cm apart; a strip of floor lies between them.
    Quad strip;
    strip.corner = {0, 0, 0.0f};
    strip.edge_u = {0, 0, 0.05f};
    strip.edge_v = {4, 0, 0};
    strip.res_v = 4;
    std::vector<Quad> quads{strip};
    add_box(quads, {-1, 0, -1}, {5, 3, 0.0f}, bottomless);
    add_box(quads, {-1, 0, 0.05f}, {5, 3, 1}, bottomless);
    const std::vector<bool> result = buried(quads);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_FALSE(result[i]) << i;
}

TEST(Buried, TheFloorUnderADoubleSidedHoodIsNotUnlessItLiesOnTheFloor)
{
    Quad thick;
    thick.double_sided = true;
    std::vector<Quad> quads{floor_8x8()};
    add_box(quads, {2, 0, 3}, {5, 2, 6}, bottomless, false, thick);
    EXPECT_FALSE(buried(quads)[8 * 3 + 4]);

    Quad carpet = floor_8x8();
    carpet.corner.y = 1e-3f;
    carpet.double_sided = true;
    EXPECT_TRUE(buried({floor_8x8(), carpet})[8 * 3 + 4]);
}

TEST(Buried, MirroredInstancesAreJudgedAlike)
{
    const glm::mat4 mirror(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    std::vector<Quad> quads{floor_8x8()};
    add_box(quads, {2, 0, 3}, {5, 2, 6}, bottomless);
    HandMade made;
    for (const Quad& quad : quads) {
        support::add_lumels(made.lumels, quad, std::uint32_t(made.scene.instances.size()), mirror);
        support::add_quad(made.scene, quad, mirror);
    }
    expect_buried_floor(buried(made), 2, 5, 3, 6);
}

}  // namespace
}  // namespace lumel
