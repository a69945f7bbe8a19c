// The floor of a house on a slab on a ground, whichever surface is the lowest.

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "results/measure/room_floor.h"

namespace lumel {
namespace {

/// Adds a closed box.
void add_solid(Scene& scene, const glm::vec3& low, const glm::vec3& high)
{
    std::vector<glm::vec3> corners;
    for (int k = 0; k < 8; ++k)
        corners.push_back({k & 1 ? high.x : low.x, k & 2 ? high.y : low.y, k & 4 ? high.z : low.z});
    support::add_mesh(scene, corners, {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                       1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3},
                      {});
}

/// Slab, walls and desks on a ground of 30 × 30 m; the floor is at y = 1 m.
Scene house(bool has_roof)
{
    Scene scene;
    support::add_mesh(scene, {{-15, 0.7f, -15}, {15, 0.7f, -15}, {15, 0.7f, 15}, {-15, 0.7f, 15}},
                      {0, 2, 1, 0, 3, 2}, {});
    add_solid(scene, {-0.3f, 0.8f, -0.3f}, {6.3f, 1.0f, 4.3f});
    add_solid(scene, {-0.3f, 1.0f, 0}, {0, 3.6f, 4});
    add_solid(scene, {6, 1.0f, 0}, {6.3f, 3.6f, 4});
    add_solid(scene, {0, 1.0f, -0.3f}, {6, 3.6f, 0});
    add_solid(scene, {0, 1.0f, 4}, {6, 3.6f, 4.3f});
    add_solid(scene, {1, 1.7f, 1}, {2.5f, 1.75f, 2.5f});
    add_solid(scene, {3.5f, 1.0f, 1}, {5, 1.8f, 3});
    if (has_roof)
        add_solid(scene, {-0.8f, 3.6f, -0.8f}, {6.8f, 3.8f, 4.8f});
    return scene;
}

TEST(RoomFloor, IsNeitherTheGroundNorADeskAndEndsAtTheWalls)
{
    const Scene scene = house(true);
    const RayScene rays(scene);
    for (const FloorArea& area : {FloorArea{{0, 0}, {6, 4}}, FloorArea{{-15, -15}, {15, 15}}}) {
        const std::optional<RoomFloor> floor = floor_of_room(rays, area);
        ASSERT_TRUE(floor);
        EXPECT_NEAR(floor->height, 1.0, 1e-5);
        constexpr double kNear = 0.06;  // [m]
        EXPECT_NEAR(floor->area.low.x, 0.0, kNear);
        EXPECT_NEAR(floor->area.low.y, 0.0, kNear);
        EXPECT_NEAR(floor->area.high.x, 6.0, kNear);
        EXPECT_NEAR(floor->area.high.y, 4.0, kNear);
    }
}

// Only its lines meet a surface 1.5 m above another.
TEST(RoomFloor, BelowAPendantLampIsThatOfAllThatWasSearched)
{
    Scene scene = house(false);
    add_solid(scene, {2.7f, 3.0f, 1.5f}, {3.1f, 3.2f, 1.9f});
    const FloorArea area{{0, 0}, {6, 4}};
    const std::optional<RoomFloor> floor = floor_of_room(RayScene(scene), area);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->height, 1.0, 1e-5);
    EXPECT_EQ(floor->area.low, area.low);
    EXPECT_EQ(floor->area.high, area.high);
}

TEST(RoomFloor, IsNotKnownWithoutARoof)
{
    const Scene scene = house(false);
    EXPECT_FALSE(floor_of_room(RayScene(scene), {{0, 0}, {6, 4}}));
}

}  // namespace
}  // namespace lumel
