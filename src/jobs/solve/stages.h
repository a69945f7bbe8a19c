#pragma once
// Names, times and progress of a bake's stages.

#include <functional>
#include <string>
#include <vector>

#include "base/core/progress_callback.h"
#include "gpu/commands.h"
#include "jobs/solve/bake_options.h"
#include "results/record/report.h"

namespace lumel {

/// "12.3 MiB", or "1.2 KiB" if it is less than 1 MiB.
std::string memory_text(std::uint64_t bytes);

/// Throws the Error{stopped} of work that ended before there was a result.
[[noreturn]] void throw_stopped();

/// Runs work that a progress callback may stop. False if the caller has stopped it.
bool unless_stopped(const std::function<void()>& work);

/// Follows a bake from stage to stage, and tells the progress function about it.
class Stages {
public:
    explicit Stages(const ProgressFunction& progress);

    /// Ends the stage before and begins this one.
    void begin(const std::string& name);
    /// Tells how far the current stage is. False: the caller wants to stop, or has wanted to.
    bool progress(double fraction, std::uint64_t shots = 0, double error = -1.0);
    /// Tells how far the current stage is. Throws Error{stopped} if the caller wants to stop: for
    /// stages before there is anything to keep.
    ProgressCallback callback();
    /// Passes on a fact about the current stage, in one line.
    void note(const std::string& text);
    /// Warns the user; the report has it too.
    void warn(const std::string& text);
    /// Tells the user a fact worth knowing; the report has it too.
    void tell(const std::string& text);
    /// Notes what kernels took on the device [ms], longest first.
    void note_times(const gpu::StageTimes& times);
    /// Notes the largest arrays and images on the device that is watched.
    void note_arrays();
    /// From now on the end of each stage says how much memory of this device is held. It must
    /// outlive the last stage.
    void watch(const gpu::Device& device) { device_ = &device; }
    /// True once the caller has wanted to stop.
    bool stopped() const { return stopped_; }
    void end();

    const std::vector<StageTime>& times() const { return times_; }
    const std::vector<std::string>& warnings() const { return warnings_; }
    const std::vector<std::string>& told() const { return told_; }
    double seconds() const;        ///< since the first stage began
    double stage_seconds() const;  ///< since the current stage began

private:
    void report();
    std::string cost_of_stage() const;

    const ProgressFunction* progress_;
    const gpu::Device* device_ = nullptr;  ///< that is watched
    BakeProgress now_;
    std::vector<StageTime> times_;
    std::vector<std::string> warnings_, told_;
    double start_, stage_start_, stage_cpu_start_;
    bool running_ = false, stopped_ = false;
};

}  // namespace lumel
