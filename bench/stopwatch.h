#pragma once

#include <algorithm>
#include <limits>

#include "base/core/usage.h"

namespace lumel::bench {

/// Processor and wall time of what ran between start() and stop(), added up.
class Stopwatch {
public:
    void start()
    {
        cpu_start_ = cpu_seconds();
        wall_start_ = wall_seconds();
    }
    void stop()
    {
        cpu += cpu_seconds() - cpu_start_;
        wall += wall_seconds() - wall_start_;
    }
    double cpu = 0.0, wall = 0.0;

private:
    double cpu_start_ = 0.0, wall_start_ = 0.0;
};

/// Wall time of the fastest of `times` runs [s].
template <class Run>
double fastest(int times, const Run& run)
{
    double best = std::numeric_limits<double>::infinity();
    for (int n = 0; n < times; ++n) {
        Stopwatch watch;
        watch.start();
        run();
        watch.stop();
        best = std::min(best, watch.wall);
    }
    return best;
}

}  // namespace lumel::bench
