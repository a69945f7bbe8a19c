#include "gpu/pacer.h"

#include <algorithm>
#include <cmath>

namespace lumel::gpu {
namespace {

/// Smoothing of a unit's cost. Fast downwards, because the first measurement includes shader
/// compilation by the driver; slow upwards.
constexpr double kLearningDown = 0.8;
constexpr double kLearningUp = 0.3;
/// Fraction of the budget to aim for, because cost estimates are inexact.
constexpr double kHeadroom = 0.6;

}  // namespace

Pacer::Pacer(const Device& device, double budget_ms) : budget_ms_(budget_ms)
{
    for (Slot& slot : slots_)
        slot.commands = std::make_unique<Commands>(device);
}

void Pacer::work(const char* kind, std::uint32_t count, std::uint32_t probe, const Record& record)
{
    const double room = budget_ms_ * kHeadroom;
    std::uint32_t done = 0;
    if (recording_ && !current().commands->has_room_for_stages())
        flush();
    while (done < count) {
        const auto known = unit_cost_.find(kind);
        std::uint32_t units = std::min(probe, count);
        if (known != unit_cost_.end()) {
            const double cost = std::max(known->second, 1e-9);
            if (recording_ && expected_ms_ + cost * (count - done) > room)
                flush();
            const double fit = std::max(1.0, std::floor(room / cost));
            units = fit >= double(count - done) ? count - done : std::uint32_t(fit);
            expected_ms_ += cost * units;
        } else if (recording_)
            flush();
        units = std::min(units, count - done);

        Slot& slot = current();
        slot.commands->stage(kind);
        record(*slot.commands, done, done + units);
        slot.units[kind] += units;
        recording_ = true;
        done += units;
        if (known == unit_cost_.end())
            wait(flush());
    }
}

void Pacer::work(const char* kind, const std::function<void(Commands&)>& record)
{
    work(kind, 1, 1, [&](Commands& commands, std::uint32_t, std::uint32_t) { record(commands); });
}

std::uint64_t Pacer::flush()
{
    if (!recording_)
        return submitted_;
    Slot& slot = current();
    slot.commands->submit();
    slot.in_flight = true;
    slot.ticket = ++submitted_;
    recording_ = false;
    expected_ms_ = 0.0;
    collect(current());  // the next slot to record must be free
    return submitted_;
}

void Pacer::collect(Slot& slot)
{
    if (!slot.in_flight)
        return;
    slot.commands->wait();
    slot.in_flight = false;
    for (const auto& [kind, ms] : slot.commands->take_times()) {
        times_[kind] += ms;
        const auto units = slot.units.find(kind);
        if (units == slot.units.end())
            continue;
        const double cost = ms / units->second;
        const auto [entry, fresh] = unit_cost_.try_emplace(kind, cost);
        if (!fresh)
            entry->second +=
                (cost < entry->second ? kLearningDown : kLearningUp) * (cost - entry->second);
    }
    slot.units.clear();
    longest_ms_ = std::max(longest_ms_, slot.commands->last_milliseconds());
}

void Pacer::wait(std::uint64_t ticket)
{
    if (ticket > submitted_)
        flush();
    for (std::uint64_t t = ticket > kSlots ? ticket - kSlots + 1 : 1; t <= ticket; ++t)
        for (Slot& slot : slots_)
            if (slot.in_flight && slot.ticket == t)
                collect(slot);
}

void Pacer::finish()
{
    flush();
    wait(submitted_);
}

}  // namespace lumel::gpu
