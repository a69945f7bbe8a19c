// Matrices of low rank.

#include <gtest/gtest.h>

#include "bench/papers/matrix_low_rank_product.h"
#include "tests/solve/matrix/products.h"
#include "tests/solve/matrix/test_room.h"

namespace lumel::bench {
namespace {

constexpr std::uint32_t kSize = 203;  // no multiple of anything

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

TEST(LowRank, OnTheGpuIsTheStoredMatrix)
{
    const gpu::Device device;
    const TestRoom room = sphere_room(kSize, 2);
    const ColorMatrix once = color_matrix(room.form_factors, room.elements.color);
    const LowRankMatrix compressed = compress_low_rank(once, room.elements, 9);
    const std::vector<glm::vec3> x = random_light(3 * kSize);
    expect_products(on_gpu(device, MultiplyLowRank(device, compressed, 3), x, 3),
                    decompress(compressed), x, kSumRounding);
    EXPECT_EQ(device.validation_messages(), "");
}

}  // namespace
}  // namespace lumel::bench
