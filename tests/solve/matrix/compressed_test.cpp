// Forms that use what a matrix of light has in itself.

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/matrix/balanced.h"
#include "solve/matrix/clusters.h"
#include "solve/matrix/compressed_tiles.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

TEST(Balanced, IsSymmetricAndComesBack)
{
    const TestRoom room = sphere_room(40, 1);
    const ColorMatrix matrix = all_bounces(room), balance = balanced(matrix, room.elements);
    for (int c = 0; c < 2; ++c)
        for (std::uint32_t i = 0; i < 40; ++i)
            for (std::uint32_t j = 0; j < i; ++j)
                EXPECT_NEAR(balance.channel[c].at(i, j), balance.channel[c].at(j, i),
                            1e-5f * std::abs(balance.channel[c].at(i, j)));
    const ColorMatrix back = unbalanced(balance, room.elements.color, root_areas(room.elements));
    EXPECT_LT(relative_error(back, matrix, room.elements), 1e-6);
}

TEST(Clusters, HoldEveryPatchOnceAndNeighboursTogether)
{
    const TestRoom room = box_room(16);
    std::vector<std::uint32_t> order = cluster_order(room.elements, 64);
    double apart = 0.0, at_random = 0.0;
    for (std::size_t i = 0; i < order.size(); ++i) {
        const glm::vec3 first = room.elements.place[order[i / 64 * 64]];
        apart += double(glm::distance(room.elements.place[order[i]], first));
        at_random += double(glm::distance(room.elements.place[order[i]], room.elements.place[i]));
    }
    EXPECT_LT(apart, 0.5 * at_random);
    std::sort(order.begin(), order.end());
    std::vector<std::uint32_t> all(order.size());
    std::iota(all.begin(), all.end(), 0u);
    EXPECT_EQ(order, all);
}

// Its 100 patches fill one cluster and a part of another.
TEST(Tiles, ASphereIsOneTile)
{
    const TestRoom room = sphere_room(100, 3);
    const ColorMatrix matrix = all_bounces(room);
    const TiledMatrix compressed = compress_tiles(matrix, room.elements, {.error = 0.01f});
    std::size_t tiles = 0;
    for (const std::array<TileRows, 3>& axes : compressed.tiles)
        tiles += axes[0].place.size();
    EXPECT_LE(tiles, 4u);
    EXPECT_LT(relative_error(decompress(compressed), matrix, room.elements), 0.02);
}

TEST(Tiles, AreCloserTheLessErrorIsAskedFor)
{
    const TestRoom room = box_room(10);
    const ColorMatrix matrix = all_bounces(room);
    double last = INFINITY;
    std::size_t last_bytes = 0;
    for (const float error : {0.1f, 0.01f, 0.001f}) {
        const TiledMatrix compressed = compress_tiles(matrix, room.elements, {.error = error});
        const double found = relative_error(decompress(compressed), matrix, room.elements);
        EXPECT_LT(found, last);
        EXPECT_GT(compressed.bytes(), last_bytes);
        last = found;
        last_bytes = compressed.bytes();
    }
    EXPECT_LT(last, 0.01);
}

TEST(Tiles, NeedEveryPatchDescribed)
{
    TestRoom room = sphere_room(10, 4);
    const ColorMatrix matrix = all_bounces(room);
    room.elements.normal.pop_back();
    EXPECT_THROW(compress_tiles(matrix, room.elements, {}), Error);
    room = sphere_room(10, 4);
    room.elements.area[3] = 0.0f;
    EXPECT_THROW(compress_tiles(matrix, room.elements, {}), Error);
}

}  // namespace
}  // namespace lumel
