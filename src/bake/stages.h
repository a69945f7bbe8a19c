#pragma once
// Names, times and progress of a bake's stages.

#include <string>
#include <vector>

#include "bake/bake.h"
#include "record/report.h"

namespace lumel {

/// Follows a bake from stage to stage, and tells the progress function about it.
class Stages {
public:
    explicit Stages(const ProgressFunction& progress);

    /// Ends the stage before and begins this one.
    void begin(const std::string& name);
    /// Tells how far the current stage is. False: the caller wants to stop, or has wanted to.
    bool tell(double fraction, std::uint64_t shots = 0, double error = -1.0);
    /// True once the caller has wanted to stop.
    bool stopped() const { return stopped_; }
    void end();

    const std::vector<StageTime>& times() const { return times_; }
    double seconds() const;        ///< since the first stage began
    double stage_seconds() const;  ///< since the current stage began

private:
    const ProgressFunction* progress_;
    std::vector<StageTime> times_;
    double start_, stage_start_, stage_cpu_start_;
    bool running_ = false, stopped_ = false;
};

}  // namespace lumel
