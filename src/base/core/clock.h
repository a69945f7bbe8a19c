#pragma once
// Wall-clock times.

#include <chrono>

namespace lumel {

using Clock = std::chrono::steady_clock;

inline double ms_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace lumel
