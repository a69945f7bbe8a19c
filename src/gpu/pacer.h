#pragma once
// Splits long work into short submissions, to respect the time limits of drivers and keep the
// display of a shared GPU responsive.

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "gpu/commands.h"

namespace lumel::gpu {

/// Groups work into submissions with an expected GPU time of at most `budget`. It estimates the
/// cost per unit of each kind of work from timestamps; a small part of a new kind is measured
/// first. Splitting never changes a result, if the units of one kind are independent.
class Pacer {
public:
    using Record = std::function<void(Commands&, std::uint32_t first, std::uint32_t last)>;

    explicit Pacer(const Device& device, double budget_ms = 50.0);

    /// Records units [0, count) of a kind of work, in one piece if it fits. `probe`: number of
    /// units to measure first if the cost is unknown.
    void work(const char* kind, std::uint32_t count, std::uint32_t probe, const Record& record);
    /// Records indivisible work: one unit.
    void work(const char* kind, const std::function<void(Commands&)>& record);

    /// Runs a kernel for at least `threads` invocations, as indivisible work.
    template <class Shader>
    void dispatch(const char* kind, const Kernel<Shader>& kernel,
                  const typename Shader::Bindings& given, const typename Shader::Params& params,
                  std::size_t threads)
    {
        work(kind, [&](Commands& commands) { commands.dispatch(kernel, given, params, threads); });
    }
    /// Runs a kernel with one invocation for each of `count` units, whose dispatches read theirs
    /// from Params::range. probe: as for work().
    template <class Shader>
    void dispatch_parts(const char* kind, std::uint32_t count, std::uint32_t probe,
                        const Kernel<Shader>& kernel, const typename Shader::Bindings& given,
                        typename Shader::Params params)
    {
        work(kind, count, probe, [&](Commands& commands, std::uint32_t first, std::uint32_t last) {
            params.range = {first, last};
            commands.dispatch(kernel, given, params, last - first);
        });
    }

    /// Submits the recorded commands. Returns a ticket for wait().
    std::uint64_t flush();
    /// Waits until the submission of that ticket has finished.
    void wait(std::uint64_t ticket);
    /// Calls flush() and waits for all submissions.
    void finish();

    /// GPU time per kind [ms] of all finished submissions.
    const StageTimes& times() const { return times_; }
    double longest_ms() const { return longest_ms_; }  ///< longest submission so far
    std::uint64_t submissions() const { return submitted_; }

private:
    struct Slot {
        std::unique_ptr<Commands> commands;
        std::map<std::string, double> units;  ///< recorded per kind
        std::uint64_t ticket = 0;
        bool in_flight = false;
    };

    static constexpr std::size_t kSlots = 3;  ///< submissions in flight

    Slot& current() { return slots_[submitted_ % kSlots]; }
    void collect(Slot& slot);

    double budget_ms_;
    std::array<Slot, kSlots> slots_;
    std::uint64_t submitted_ = 0;
    double expected_ms_ = 0.0;                 ///< cost of the current recording [ms]
    std::map<std::string, double> unit_cost_;  ///< [ms]
    StageTimes times_;
    double longest_ms_ = 0.0;
    bool recording_ = false;
};

}  // namespace lumel::gpu
