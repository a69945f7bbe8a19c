#include "core/parallel.h"

#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace lumel {
namespace {

TEST(ParallelFor, VisitsEveryIndexOnce)
{
    for (const std::size_t count : {0u, 1u, 7u, 10'000u})
        for (const std::size_t grain : {0u, 1u, 64u, 100'000u}) {
            std::vector<std::atomic<int>> visits(count);
            parallel_for(count, grain, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = first; i < last; ++i)
                    ++visits[i];
            });
            for (std::size_t i = 0; i < count; ++i)
                ASSERT_EQ(visits[i], 1) << "index " << i << " of " << count << ", grain " << grain;
        }
}

TEST(ParallelFor, HandsAnExceptionOfItsBodyToTheCaller)
{
    const auto body = [](std::size_t first, std::size_t last) {
        if (first <= 500 && 500 < last)
            throw std::runtime_error("index 500");
    };
    EXPECT_THROW(parallel_for(1000, 1, body), std::runtime_error);
}

}  // namespace
}  // namespace lumel
