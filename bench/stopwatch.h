#pragma once

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

}  // namespace lumel::bench
