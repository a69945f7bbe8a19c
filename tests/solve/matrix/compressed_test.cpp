// Forms that use what a matrix of light has in itself.

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "base/core/error.h"
#include "solve/matrix/balanced.h"
#include "solve/matrix/clusters.h"
#include "solve/matrix/compressed_low_rank.h"
#include "solve/matrix/compressed_tiles.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel {
namespace {

/// A box of unit walls whose patches are seen at their middles: smooth, with sharp edges.
TestRoom box_room(std::uint32_t side)
{
    TestRoom room;
    Elements& e = room.elements;
    for (int axis = 0; axis < 3; ++axis)
        for (const float wall : {0.0f, 1.0f})
            for (std::uint32_t i = 0; i < side * side; ++i) {
                glm::vec3 place(wall), normal(0.0f);
                const std::uint32_t column = i % side, row = i / side;
                place[(axis + 1) % 3] = (float(column) + 0.5f) / float(side);
                place[(axis + 2) % 3] = (float(row) + 0.5f) / float(side);
                normal[axis] = 1.0f - 2.0f * wall;
                e.place.push_back(place);
                e.normal.push_back(normal);
                e.area.push_back(1.0f / float(side * side));
                e.color.emplace_back(axis == 0 ? 0.6f : 0.3f, 0.5f, i % 7 == 0 ? 0.0f : 0.7f);
            }
    const std::size_t n = e.place.size();
    room.form_factors = {std::uint32_t(n), std::vector<float>(n * n)};
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const glm::vec3 to = e.place[j] - e.place[i];
            const float square = std::max(glm::dot(to, to), 1e-12f);
            const float cosines = std::max(glm::dot(to, e.normal[i]), 0.0f) *
                                  std::max(-glm::dot(to, e.normal[j]), 0.0f) / square;
            room.form_factors.values[i * n + j] =
                cosines * e.area[j] / (3.14159265f * square + e.area[j]);
        }
    return room;
}

/// Relative error of light, over patches by area, where each patch in turn is the lit one.
double relative_error(const ColorMatrix& found, const ColorMatrix& truth, const Elements& elements)
{
    double off = 0.0, all = 0.0;
    for (int c = 0; c < 3; ++c)
        for (std::uint32_t i = 0; i < truth.size(); ++i)
            for (std::uint32_t j = 0; j < truth.size(); ++j) {
                const double value = double(truth.channel[c].at(i, j));
                off += double(elements.area[i]) *
                       std::pow(double(found.channel[c].at(i, j)) - value, 2);
                all += double(elements.area[i]) * value * value;
            }
    return std::sqrt(off / all);
}

ColorMatrix all_bounces(const TestRoom& room)
{
    return bounces(color_matrix(room.form_factors, room.elements.color), kAllBounces);
}

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

// All patches of a sphere send alike, whatever the number of bounces: one pattern of light.
TEST(LowRank, ASphereHasRankOne)
{
    const TestRoom room = sphere_room(100, 2);
    const ColorMatrix matrix = all_bounces(room);
    const LowRankMatrix compressed = compress_low_rank(matrix, room.elements, 1);
    EXPECT_EQ(compressed.bytes(), 2u * 100u + 3u * 2u + 100u * 16u);
    EXPECT_LT(relative_error(decompress(compressed), matrix, room.elements), 1e-3);
}

TEST(LowRank, OfFullRankIsTheMatrix)
{
    const TestRoom room = box_room(5);
    const ColorMatrix matrix = all_bounces(room);
    const LowRankMatrix compressed = compress_low_rank(matrix, room.elements, 1000);
    EXPECT_LT(relative_error(decompress(compressed), matrix, room.elements), 2e-3);
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
