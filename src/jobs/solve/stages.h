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

/// "1.5 %" or "110 %": two digits, or all before the point.
std::string percent_text(double fraction);

/// Throws Error{stopped} for work that ended without a result.
[[noreturn]] void throw_stopped();

/// Runs work with a progress callback. Returns false if the caller stopped it.
bool unless_stopped(const std::function<void()>& work);

/// Tracks the stages of a bake, and reports to the progress function.
class Stages {
public:
    explicit Stages(const ProgressFunction& progress);

    /// Ends the previous stage and begins this one.
    void begin(const std::string& name);
    /// Reports progress of the current stage. Returns false if the caller wants, or wanted, to
    /// stop.
    bool progress(double fraction, std::uint64_t shots = 0, double error = -1.0);
    /// Progress callback of the current stage. Throws Error{stopped} if the caller wants to stop:
    /// for stages without results to keep.
    ProgressCallback callback();
    /// Reports a one-line fact about the current stage.
    void note(const std::string& text);
    /// Warns the user; also in the report.
    void warn(const std::string& text);
    /// Reports a fact to the user; also in the report.
    void tell(const std::string& text);
    /// Notes GPU times of kernels [ms], longest first.
    void note_times(const gpu::StageTimes& times);
    /// Notes the largest arrays and images on the watched device.
    void note_arrays();
    /// Adds the memory in use on this device to the end of each stage. It must outlive the last
    /// stage.
    void watch(const gpu::Device& device) { device_ = &device; }
    /// True once the caller has requested to stop.
    bool stopped() const { return stopped_; }
    /// As if the caller had.
    void stop() { stopped_ = true; }
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
