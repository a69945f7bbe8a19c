// Matrices in hierarchies of blocks of low rank.

#include <gtest/gtest.h>

#include "bench/papers/matrix_hierarchy_product.h"
#include "solve/matrix/balanced.h"
#include "tests/solve/matrix/products.h"
#include "tests/solve/matrix/random_matrix.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel::bench {
namespace {

/// Of K, which counts patches by their areas.
double balanced_error(const ColorMatrix& found, const ColorMatrix& truth, const Elements& elements)
{
    const ColorMatrix a = balanced(found, elements), b = balanced(truth, elements);
    ColorMatrix zero = b;
    for (SquareMatrix& channel : zero.channel)
        channel.values.assign(channel.values.size(), 0.0f);
    return std::sqrt(squared_difference(a, b) / squared_difference(b, zero));
}

// 1e-3 more for half floats.
TEST(Hierarchy, KeepsTheErrorThatIsAskedInFewerBytes)
{
    const TestRoom room = box_room(12);
    const ColorMatrix matrix = all_bounces(room);
    std::size_t bytes = 3 * 2 * std::size_t(matrix.size()) * matrix.size();
    for (const float error : {0.01f, 0.05f}) {
        const HierarchicalMatrix compressed = compress_hierarchy(matrix, room.elements, error);
        EXPECT_LT(balanced_error(decompress(compressed), matrix, room.elements), error + 1e-3f);
        EXPECT_LT(compressed.bytes(), bytes);
        bytes = compressed.bytes();
    }
}

// All patches of a sphere send alike: one block of rank 1 for each channel that reflects.
TEST(Hierarchy, ASphereIsOneBlockOfRankOne)
{
    const TestRoom room = sphere_room(100, 2);
    const HierarchicalMatrix compressed =
        compress_hierarchy(all_bounces(room), room.elements, 1e-3f);
    for (const std::vector<HierarchyBlock>& blocks : compressed.blocks) {
        ASSERT_EQ(blocks.size(), 1u);
        EXPECT_EQ(blocks[0].rank, 1u);
        EXPECT_EQ(blocks[0].rows, 100u);
    }
}

TEST(Hierarchy, OnTheGpuIsTheStoredMatrix)
{
    const gpu::Device device;
    const TestRoom room = box_room(7);  // 294 patches: blocks of odd sides
    const HierarchicalMatrix compressed =
        compress_hierarchy(all_bounces(room), room.elements, 0.02f);
    const std::vector<glm::vec3> x = random_light(room.elements.area.size());
    expect_products(on_gpu(device, MultiplyHierarchy(device, compressed, 1), x, 1),
                    decompress(compressed), x, kSumRounding);
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel::bench
