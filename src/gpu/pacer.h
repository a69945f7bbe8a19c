#pragma once
// Long work in short submissions, so that no driver's time limit is met and the screen of a
// shared GPU stays alive.

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "gpu/commands.h"

namespace lumel::gpu {

/// Collects work into submissions that are expected to take at most `budget` on the device. It
/// learns what a unit of each kind of work costs from timestamps; the first time a kind is met,
/// a small part is run and measured alone. How work is cut never changes its result, as long as
/// the units of one kind are independent of each other.
class Pacer {
public:
    using Record = std::function<void(Commands&, std::uint32_t first, std::uint32_t last)>;

    explicit Pacer(const Device& device, double budget_ms = 50.0);

    /// Records units [0, count) of a kind of work, in one piece if it fits. `probe`: units to
    /// try first when the cost is not known yet.
    void work(const char* kind, std::uint32_t count, std::uint32_t probe, const Record& record);
    /// The same of work that is never cut: one unit.
    void work(const char* kind, const std::function<void(Commands&)>& record);

    /// Submits what is recorded. Returns a ticket for wait().
    std::uint64_t flush();
    /// Returns once the submission of that ticket has finished.
    void wait(std::uint64_t ticket);
    /// flush() and wait for everything.
    void finish();

    /// Device time per kind [ms], of all finished submissions.
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
    double expected_ms_ = 0.0;                 ///< of what is recorded now
    std::map<std::string, double> unit_cost_;  ///< [ms]
    StageTimes times_;
    double longest_ms_ = 0.0;
    bool recording_ = false;
};

}  // namespace lumel::gpu
