// Lumels at ray hits.

#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "../../support/box_lumels.h"
#include "atlas/cells/near_lumels.h"

namespace lumel {
namespace {

using support::HandMade;
using support::Quad;

constexpr int kAcross = 7, kDown = 5;

/// Two walls, of which the first has a buried lumel at its first texel.
struct Walls {
    std::vector<Quad> quads;
    HandMade made;
    Atlas atlas;

    Walls()
    {
        Quad one;
        one.res_u = kAcross;
        one.res_v = kDown;
        Quad other = one;
        other.corner.z = 1.0f;
        quads = {one, other};
        made = support::make_quads(quads);
        atlas = support::lay_out(made, quads);
        made.lumels.lumels[0].flags |= kLumelBuried;
    }

    /// A hit on the front of a wall, at a point of the unit square.
    static RayHit hit(std::uint32_t wall, const glm::vec2& at)
    {
        RayHit hit{.instance = wall, .distance = 1.0f};
        hit.triangle = at.y > at.x ? 1 : 0;
        hit.barycentric =
            hit.triangle == 0 ? glm::vec2(at.x - at.y, at.y) : glm::vec2(at.x, at.y - at.x);
        return hit;
    }

    std::uint32_t lumel(std::uint32_t wall, int x, int y) const
    {
        return std::uint32_t(made.first[wall] + std::size_t(y * kAcross + x));
    }
};

/// However many are looked up at once.
TEST(NearLumels, AreThoseOfTheTexelsThatWereHit)
{
    const Walls walls;
    const NearLumels near(walls.made.scene, walls.atlas, walls.made.lumels);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number;
    for (const std::size_t count : {0, 1, 63, 64, 65, 130, 1000}) {
        std::vector<RayHit> hits;
        std::vector<std::uint32_t> expected;
        while (hits.size() < count) {
            const auto wall = std::uint32_t(hits.size() % 2);
            const glm::vec2 at(number(random), number(random));
            const int x = int(at.x * kAcross), y = int(at.y * kDown);
            if (wall == 0 && x == 0 && y == 0)
                continue;  // buried
            hits.push_back(Walls::hit(wall, at));
            expected.push_back(walls.lumel(wall, x, y));
            if (hits.size() % 5 == 0) {
                hits.back().distance = std::numeric_limits<float>::infinity();
                expected.back() = kNoLumel;
            } else if (hits.size() % 7 == 0) {
                hits.back().front = false;  // there are no lumels
                expected.back() = kNoLumel;
            }
        }
        std::vector<std::uint32_t> found;
        near.find(hits, found);
        EXPECT_EQ(found, expected) << count;
    }
}

TEST(NearLumels, ABuriedOneIsItsNeighbour)
{
    const Walls walls;
    const NearLumels near(walls.made.scene, walls.atlas, walls.made.lumels);
    const glm::vec2 texel(1.0f / kAcross, 1.0f / kDown);
    std::vector<std::uint32_t> found;
    near.find(std::vector{Walls::hit(0, glm::vec2(0.9f, 0.5f) * texel),
                          Walls::hit(0, glm::vec2(0.5f, 0.9f) * texel)},
              found);
    EXPECT_EQ(found, (std::vector{walls.lumel(0, 1, 0), walls.lumel(0, 0, 1)}));
}

}  // namespace
}  // namespace lumel
