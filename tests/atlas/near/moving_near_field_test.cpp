// After things have moved, the table of near pairs is that of a new build.

#include <array>
#include <random>
#include <vector>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "atlas/near/moving_near_field.h"

namespace lumel {
namespace {

using support::HandMade;
using support::Quad;

constexpr float kRoom = 4.0f;    ///< [m]
constexpr float kPlate = 1e-3f;  ///< between the faces of the thin thing: rows there exceed 1 [m]
constexpr int kMoves = 20;

/// A room in which a block and a pair of plates, face to face, may move.
struct Furnished {
    HandMade made;
    std::array<std::vector<std::uint32_t>, 2> things;  ///< instances of each
    std::vector<char> movers;

    explicit Furnished(int resolution)
    {
        Quad look;
        look.res_u = look.res_v = 2 * resolution;
        std::vector<Quad> quads;
        for (const Quad& wall : support::box_walls(glm::vec3(0.0f), glm::vec3(kRoom), true, look))
            quads.push_back(wall);
        look.res_u = look.res_v = resolution;
        for (const Quad& side :
             support::box_walls(glm::vec3(-0.4f), glm::vec3(0.4f, 0.3f, 0.4f), false, look))
            quads.push_back(side);
        Quad left = look, right = look;
        left.res_u = resolution + 1;
        right.corner = {1.0f, 0.0f, kPlate};
        right.edge_u = {-1.0f, 0.0f, 0.0f};
        right.res_v = resolution + 2;
        quads.push_back(left);
        quads.push_back(right);
        made = support::make_quads(quads);
        for (std::uint32_t i = 0; i < quads.size(); ++i)
            if (i >= 6)
                things[i < 12 ? 0 : 1].push_back(i);
        movers.assign(quads.size(), 0);
        for (const auto& thing : things)
            for (const std::uint32_t i : thing)
                movers[i] = 1;
    }

    /// Around all instances of a thing.
    Box box(std::size_t thing) const
    {
        const RayScene alone(made.scene, things[thing]);
        return {alone.low(), alone.high()};
    }

    void place(std::size_t thing, const glm::mat4& transform)
    {
        for (const std::uint32_t i : things[thing])
            made.scene.instances[i].transform = transform;
    }
};

/// Anywhere in the room, through its walls too by a little, turned anyhow.
glm::mat4 random_place(std::mt19937& random)
{
    std::uniform_real_distribution<float> place(0.5f, kRoom - 1.2f), part(-1.0f, 1.0f);
    const glm::vec3 to(place(random), place(random), place(random));
    const glm::vec3 axis(part(random), part(random), 1.5f);
    return glm::rotate(glm::translate(glm::mat4(1.0f), to), 0.3f * part(random), axis);
}

class MovingNearFields : public testing::TestWithParam<NearPairsOf> {};

INSTANTIATE_TEST_SUITE_P(Of, MovingNearFields,
                         testing::Values(NearPairsOf::all, NearPairsOf::movers),
                         [](const auto& test) {
                             return test.param == NearPairsOf::all ? "all" : "movers";
                         });

/// Columns and factors of a row.
std::vector<std::pair<std::uint32_t, float>> row_of(const NearField& table, std::size_t i)
{
    std::vector<std::pair<std::uint32_t, float>> row;
    for (std::uint32_t k = table.first[i]; k < table.first[i + 1]; ++k)
        row.emplace_back(table.column[k], table.factor[k]);
    return row;
}

TEST_P(MovingNearFields, AfterRandomMovesHoldWhatANewOneHoldsBitForBit)
{
    Furnished room(6);
    std::mt19937 random(3);
    for (const std::size_t thing : {0, 1})
        room.place(thing, random_place(random));
    RayScene rays(room.made.scene, room.movers);
    MovingNearField moving(room.made.scene, rays, room.made.lumels, {}, room.movers, GetParam());
    std::size_t scaled = 0, changed = 0;
    for (int move = 0; move < kMoves; ++move) {
        const std::size_t thing = random() % 2;
        const std::vector<float> factors = moving.table().factor;
        const Box before = room.box(thing);
        room.place(thing, random_place(random));
        rays.place(room.things[thing]);
        moving.follow(room.made.scene, rays, room.things[thing],
                      std::array{before, room.box(thing)});
        const MovingNearField fresh(room.made.scene, RayScene(room.made.scene), room.made.lumels,
                                    {}, room.movers, GetParam());
        ASSERT_EQ(moving.table().first, fresh.table().first) << move;
        ASSERT_EQ(moving.table().column, fresh.table().column) << move;
        ASSERT_EQ(moving.table().factor, fresh.table().factor) << move;
        changed += moving.table().factor != factors;
        for (std::size_t i = 0; i < room.made.lumels.lumels.size(); ++i) {
            float sum = 0.0f;
            for (const auto& [column, factor] : row_of(moving.table(), i))
                sum += factor;
            EXPECT_LE(sum, 1.0f + 1e-5f);
            scaled += sum > 1.0f - 1e-5f;
        }
    }
    EXPECT_EQ(changed, std::size_t(kMoves));
    EXPECT_GT(scaled, 0u);
}

// Here most lumels are far from what moves: pairs that end just beyond its reach count.
TEST(MovingNearField, WithAReachMuchSmallerThanTheRoomIsThatOfANewOneToo)
{
    const NearFieldOptions options{.radius = 3.0f};
    Furnished room(9);
    std::mt19937 random(11);
    for (const std::size_t thing : {0, 1})
        room.place(thing, random_place(random));
    RayScene rays(room.made.scene, room.movers);
    MovingNearField moving(room.made.scene, rays, room.made.lumels, options, room.movers,
                           NearPairsOf::all);
    for (int move = 0; move < 3 * kMoves; ++move) {
        const std::size_t thing = random() % 2;
        const Box before = room.box(thing);
        room.place(thing, random_place(random));
        rays.place(room.things[thing]);
        moving.follow(room.made.scene, rays, room.things[thing],
                      std::array{before, room.box(thing)});
        const NearField fresh =
            build_near_field(room.made.scene, RayScene(room.made.scene), room.made.lumels, options);
        ASSERT_EQ(moving.table().first, fresh.first) << move;
        ASSERT_EQ(moving.table().column, fresh.column) << move;
        ASSERT_EQ(moving.table().factor, fresh.factor) << move;
    }
}

TEST(MovingNearField, OfAllPairsIsTheNearFieldOfTheScene)
{
    Furnished room(6);
    std::mt19937 random(5);
    for (const std::size_t thing : {0, 1})
        room.place(thing, random_place(random));
    const RayScene rays(room.made.scene);
    const NearField whole = build_near_field(room.made.scene, rays, room.made.lumels, {});
    const MovingNearField all(room.made.scene, rays, room.made.lumels, {}, room.movers,
                              NearPairsOf::all);
    EXPECT_EQ(all.table().first, whole.first);
    EXPECT_EQ(all.table().column, whole.column);
    EXPECT_EQ(all.table().factor, whole.factor);
    EXPECT_EQ(all.table().radius, whole.radius);
}

TEST(MovingNearField, OfMoversHasNoPairOfLumelsThatStay)
{
    Furnished room(4);
    std::mt19937 random(9);
    for (const std::size_t thing : {0, 1})
        room.place(thing, random_place(random));
    const MovingNearField moving(room.made.scene, RayScene(room.made.scene), room.made.lumels, {},
                                 room.movers, NearPairsOf::movers);
    const auto moves = [&](std::size_t i) {
        return room.movers[room.made.lumels.lumels[i].instance] != 0;
    };
    std::size_t pairs = 0;
    for (std::size_t i = 0; i < room.made.lumels.lumels.size(); ++i)
        for (const auto& [column, factor] : row_of(moving.table(), i)) {
            EXPECT_TRUE(moves(i) || moves(column));
            ++pairs;
        }
    EXPECT_GT(pairs, 0u);
}

}  // namespace
}  // namespace lumel
