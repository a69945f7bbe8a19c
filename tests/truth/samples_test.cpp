#include "rays/paths/samples.h"

#include <cmath>
#include <set>
#include <utility>

#include <gtest/gtest.h>

namespace lumel {
namespace {

TEST(Samples, EveryAlignedRunOfPointsIsANet)
{
    // 2^k points put exactly one into each box of size 2^-a x 2^-(k - a), for every a.
    for (std::uint32_t stream = 0; stream < 5; ++stream)
        for (std::uint32_t k = 1; k <= 8; ++k)
            for (std::uint32_t a = 0; a <= k; ++a) {
                std::set<std::pair<int, int>> boxes;
                const std::uint32_t first = 3u << k;
                for (std::uint32_t i = first; i < first + (1u << k); ++i) {
                    const glm::vec2 at = PathSamples(stream, i).stratified(stream);
                    boxes.emplace(int(at.x * float(1 << a)), int(at.y * float(1 << (k - a))));
                }
                ASSERT_EQ(boxes.size(), std::size_t(1) << k);
            }
}

TEST(Samples, StreamsAndPairsAreIndependent)
{
    constexpr int kCount = 4096;
    double across_pairs = 0.0, across_streams = 0.0, random = 0.0;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const glm::vec2 a = PathSamples(1, i).stratified(0) - 0.5f;
        const glm::vec2 b = PathSamples(1, i).stratified(1) - 0.5f;
        const glm::vec2 c = PathSamples(2, i).stratified(0) - 0.5f;
        const glm::vec2 d = PathSamples(1, i).random(0) - 0.5f;
        across_pairs += a.x * b.x;
        across_streams += a.x * c.x;
        random += d.x * d.y;
    }
    // Of independent numbers: mean 0, deviation 1/12 √n.
    const double limit = 5.0 / 12.0 * std::sqrt(double(kCount));
    EXPECT_LT(std::abs(across_pairs), limit);
    EXPECT_LT(std::abs(across_streams), limit);
    EXPECT_LT(std::abs(random), limit);
}

}  // namespace
}  // namespace lumel
