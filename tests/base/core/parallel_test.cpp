#include "base/core/parallel.h"

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

TEST(ParallelSteps, ReportProgressAndStopOnRequest)
{
    for (const std::size_t last : {100u, 8u}) {
        std::vector<std::atomic<int>> visits(10);
        std::vector<std::size_t> reported;
        const auto body = [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i)
                ++visits[i];
        };
        const bool finished = parallel_steps(10, 4, 1, body, [&](std::size_t done) {
            reported.push_back(done);
            return done < last;
        });
        EXPECT_EQ(finished, last > 10);
        EXPECT_EQ(reported, finished ? (std::vector<std::size_t>{4, 8, 10})
                                     : (std::vector<std::size_t>{4, 8}));
        for (std::size_t i = 0; i < visits.size(); ++i)
            EXPECT_EQ(visits[i], i < reported.back() ? 1 : 0) << "index " << i;
    }
}

}  // namespace
}  // namespace lumel
