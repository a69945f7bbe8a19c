#include "base/core/usage.h"

#include <chrono>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace lumel {
namespace {

void work_for(double seconds)
{
    const double end = cpu_seconds() + seconds;
    while (cpu_seconds() < end) {
    }
}

TEST(Usage, CpuSecondsCountTheWorkOfAllThreads)
{
    const double before = cpu_seconds();
    std::thread other(work_for, 0.05);
    other.join();
    EXPECT_GE(cpu_seconds() - before, 0.05);
}

TEST(Usage, SleepCostsWallTimeButNoProcessorTime)
{
    const double cpu = cpu_seconds();
    const double wall = wall_seconds();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_GE(wall_seconds() - wall, 0.1);
    EXPECT_LT(cpu_seconds() - cpu, 0.09);
}

TEST(Usage, PeakMemorySeesWhatWasTouched)
{
    constexpr std::size_t kBytes = 64u << 20;
    std::vector<char> block(kBytes, 1);
    EXPECT_GE(peak_memory_bytes(), kBytes);
    EXPECT_EQ(block.back(), 1);
}

}  // namespace
}  // namespace lumel
