#include "jobs/solve/stages.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/log.h"
#include "base/core/usage.h"
#include "gpu/device.h"
#include "gpu/memory.h"

namespace lumel {

std::string memory_text(std::uint64_t bytes)
{
    constexpr double kibibyte = 1024.0;
    const double kibibytes = double(bytes) / kibibyte;
    return kibibytes < kibibyte ? fmt::format("{:.1f} KiB", kibibytes)
                                : fmt::format("{:.1f} MiB", kibibytes / kibibyte);
}

std::string percent_text(double fraction)
{
    constexpr double kTwoDigits = 99.5;  // two digits of more would need an exponent
    const double percent = 100.0 * fraction;
    return percent < kTwoDigits ? fmt::format("{:.2g} %", percent)
                                : fmt::format("{:.0f} %", percent);
}

bool unless_stopped(const std::function<void()>& work)
{
    try {
        work();
        return true;
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::stopped)
            throw;
        return false;
    }
}

Stages::Stages(const ProgressFunction& progress)
    : progress_(&progress),
      start_(wall_seconds()),
      stage_start_(start_),
      stage_cpu_start_(cpu_seconds())
{
}

void Stages::begin(const std::string& name)
{
    end();
    times_.push_back({name});
    stage_start_ = wall_seconds();
    stage_cpu_start_ = cpu_seconds();
    running_ = true;
    now_ = {.stage = name};
    note("begins");
}

bool Stages::progress(double fraction, std::uint64_t shots, double error)
{
    now_.fraction = fraction;
    now_.shots = shots;
    now_.error = error;
    report();
    return !stopped_;
}

ProgressCallback Stages::callback()
{
    return [this](double fraction) {
        if (!progress(fraction))
            throw_stopped();
    };
}

void throw_stopped()
{
    throw Error(ErrorKind::stopped, "", "stopped before the first result; nothing is written");
}

void Stages::note(const std::string& text)
{
    now_.note = text;
    report();
    now_.note.clear();
}

void Stages::warn(const std::string& text)
{
    log_warning(text);
    warnings_.push_back(text);
}

void Stages::tell(const std::string& text)
{
    log_info(text);
    told_.push_back(text);
}

void Stages::note_times(const gpu::StageTimes& times)
{
    std::vector<std::pair<std::string, double>> kernels(times.begin(), times.end());
    std::stable_sort(kernels.begin(), kernels.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    for (const auto& [kernel, ms] : kernels)
        note(fmt::format("\"{}\" took {:.3f} s", kernel, ms / 1000.0));
}

void Stages::note_arrays()
{
    constexpr std::size_t kMax = 8;
    if (!device_)
        return;
    note("arrays and images on the device take " + memory_text(device_->held_bytes()) +
         ", the largest of them:");
    const std::vector<gpu::Holding> holdings = device_->memory().holdings();
    for (std::size_t i = 0; i < std::min(kMax, holdings.size()); ++i)
        note(memory_text(holdings[i].bytes) + " of " + holdings[i].name);
}

void Stages::report()
{
    now_.seconds = stage_seconds();
    if (*progress_ && !(*progress_)(now_))
        stopped_ = true;
}

void Stages::end()
{
    if (!running_)
        return;
    times_.back().wall_seconds = stage_seconds();
    times_.back().cpu_seconds = cpu_seconds() - stage_cpu_start_;
    running_ = false;
    note(cost_of_stage());
}

std::string Stages::cost_of_stage() const
{
    const StageTime& time = times_.back();
    std::string cost =
        fmt::format("took {:.3f} s wall, {:.3f} s CPU; peak memory {}", time.wall_seconds,
                    time.cpu_seconds, memory_text(peak_memory_bytes()));
    if (device_)
        cost += fmt::format(", device memory {}, peak {}", memory_text(device_->held_bytes()),
                            memory_text(device_->peak_bytes()));
    return cost;
}

double Stages::seconds() const
{
    return wall_seconds() - start_;
}

double Stages::stage_seconds() const
{
    return wall_seconds() - stage_start_;
}

}  // namespace lumel
