// The space of an L-shaped room.

#include <utility>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "results/measure/room_space.h"

namespace lumel {
namespace {

constexpr float kHigh = 2.5f;  // of the room [m]

/// A wall of one surface, seen from the left of the way from one point of the plan to another.
void add_wall(Scene& scene, const glm::vec2& from, const glm::vec2& to)
{
    support::add_quad(scene, {.corner = {from.x, 0.0f, from.y},
                              .edge_u = {0.0f, kHigh, 0.0f},
                              .edge_v = {to.x - from.x, 0.0f, to.y - from.y}});
}

/// A wall of two surfaces.
void add_partition(Scene& scene, const glm::vec2& from, const glm::vec2& to)
{
    add_wall(scene, from, to);
    add_wall(scene, to, from);
}

/// Walls around a plan, whose corners go from +x to +z.
void add_walls(Scene& scene, const std::vector<glm::vec2>& corners)
{
    for (std::size_t k = 0; k < corners.size(); ++k)
        add_wall(scene, corners[(k + 1) % corners.size()], corners[k]);
}

/// A room of 6 × 4 m without the corner beyond (4, 2), and a door to a chamber behind x = 0.
TEST(RoomSpace, IsWithoutTheNotchOfAnLShapedRoom)
{
    Scene scene;
    add_walls(scene, {{-2, 0}, {6, 0}, {6, 2}, {4, 2}, {4, 4}, {-2, 4}});
    add_partition(scene, {0, 0}, {0, 1});
    add_partition(scene, {0, 2}, {0, 4});
    const RayScene rays(scene);
    const FloorArea all{{-2, 0}, {6, 4}};
    const RoomSpace space(rays, all, 0.75, {});
    EXPECT_TRUE(space.has({1.0, 3.0}));
    EXPECT_TRUE(space.has({5.5, 1.5}));
    EXPECT_TRUE(space.has({3.97, 3.0}));
    EXPECT_TRUE(space.has({-1.0, 3.5}));  // through the door
    EXPECT_FALSE(space.has({5.5, 3.5}));
    EXPECT_FALSE(space.has({4.03, 3.0}));
    const RoomSpace notch(rays, all, 0.75, FloorArea{{4.51, 2.51}, {4.52, 2.52}});
    EXPECT_TRUE(notch.has({5.5, 3.5}));
    EXPECT_FALSE(notch.has({1.0, 3.0}));
    EXPECT_TRUE(RoomSpace(rays, all, kHigh + 0.1, {}).has({5.5, 3.5}));
}

TEST(RoomSpace, CanBeSmallerThanWhatLiesBesideIt)
{
    Scene scene;
    add_walls(scene, {{0, 0}, {20, 0}, {20, 5}, {5, 5}, {5, 20}, {0, 20}});
    const RayScene rays(scene);
    const RoomSpace space(rays, {{0, 0}, {20, 20}}, 0.75, {});
    EXPECT_TRUE(space.has({2.0, 15.0}));
    EXPECT_FALSE(space.has({12.0, 12.0}));
}

TEST(RoomSpace, IsNotTheSolidThatACorridorLeadsAround)
{
    Scene scene;
    add_walls(scene, {{0, 0}, {24, 0}, {24, 24}, {0, 24}});
    for (const auto& [from, to] : {std::pair(glm::vec2(2, 2), glm::vec2(22, 2)),
                                   {{22, 2}, {22, 22}},
                                   {{22, 22}, {2, 22}},
                                   {{2, 22}, {2, 2}}})
        add_wall(scene, from, to);
    const RayScene rays(scene);
    const RoomSpace space(rays, {{0, 0}, {24, 24}}, 0.75, {});
    EXPECT_TRUE(space.has({1.0, 12.0}));
    EXPECT_FALSE(space.has({12.0, 12.0}));
}

}  // namespace
}  // namespace lumel
