// The space of an L-shaped room.

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "results/measure/room_space.h"

namespace lumel {
namespace {

constexpr float kHigh = 2.5f;  // of the room [m]

/// Adds a wall of one surface from one point of the plan to another.
void add_wall(Scene& scene, const glm::vec2& from, const glm::vec2& to)
{
    support::add_quad(scene, {.corner = {from.x, 0.0f, from.y},
                              .edge_u = {to.x - from.x, 0.0f, to.y - from.y},
                              .edge_v = {0.0f, kHigh, 0.0f}});
}

/// A room of 6 × 4 m without the corner beyond (4, 2), and a door to a chamber behind x = 0.
TEST(RoomSpace, IsWithoutTheNotchOfAnLShapedRoom)
{
    Scene scene;
    for (const auto& [from, to] : {std::pair(glm::vec2(0, 0), glm::vec2(6, 0)),
                                   {{6, 0}, {6, 2}},
                                   {{6, 2}, {4, 2}},
                                   {{4, 2}, {4, 4}},
                                   {{4, 4}, {-2, 4}},
                                   {{-2, 4}, {-2, 0}},
                                   {{-2, 0}, {0, 0}},
                                   {{0, 0}, {0, 1}},
                                   {{0, 2}, {0, 4}}})
        add_wall(scene, from, to);
    const RayScene rays(scene);
    const FloorArea all{{-2, 0}, {6, 4}}, notch{{4, 2}, {6, 4}};
    const RoomSpace space(rays, all, all, 0.75);
    EXPECT_TRUE(space.has({1.0, 3.0}));
    EXPECT_TRUE(space.has({5.5, 1.5}));
    EXPECT_TRUE(space.has({-1.0, 3.5}));  // through the door
    EXPECT_FALSE(space.has({5.5, 3.5}));
    EXPECT_FALSE(space.has({4.5, 2.5}));
    EXPECT_TRUE(RoomSpace(rays, all, notch, 0.75).has({5.0, 3.0}));
    EXPECT_FALSE(RoomSpace(rays, all, notch, 0.75).has({1.0, 3.0}));
    EXPECT_TRUE(RoomSpace(rays, all, all, kHigh + 0.1).has({5.5, 3.5}));
}

}  // namespace
}  // namespace lumel
