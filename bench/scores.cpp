#include "bench/scores.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/core.h>

namespace lumel::bench {
namespace {

constexpr double kPercent = 100.0;

std::string percent(double part)
{
    return part < 0.0 ? "-" : fmt::format("{:.2f}", kPercent * part);
}

}  // namespace

Score::Score(std::string name, const Settings& settings, const std::optional<Truth>& truth)
    : name_(std::move(name)),
      settings_(settings),
      truth_(truth)
{
}

void Score::print_head()
{
    fmt::print("{:48}{:^28}{:^28}\n", "", "all lumels", "dark lumels");
    fmt::print("{:<20}{:>8}{:>10}{:>10}", "method", "samples", "cpu [s]", "wall [s]");
    for (int part = 0; part < 2; ++part)
        fmt::print("{:>10}{:>9}{:>9}", "RMSE %", "bias %", "stated %");
    fmt::print("\n");
}

void Score::add_row(const Standing& standing, const Stopwatch& watch,
                    const std::vector<glm::vec3>& light)
{
    fmt::print("{:<20}{:>8}{:>10.2f}{:>10.2f}", name_, standing.samples, watch.cpu, watch.wall);
    const auto print_error = [&](const LightError& error, double stated) {
        fmt::print("{:>10}{:>9}{:>9}", truth_ ? percent(error.rmse) : "-",
                   truth_ ? fmt::format("{:+.2f}", kPercent * error.bias) : "-", percent(stated));
    };
    const LightError all = truth_ ? truth_->error(light) : LightError{};
    const LightError dark = truth_ ? truth_->dark_error(light) : LightError{};
    print_error(all, standing.error);
    print_error(dark, standing.dark_error);
    fmt::print("\n");
    std::fflush(stdout);
    rows_.push_back({watch.cpu, all.rmse, dark.rmse});
}

bool Score::has_ended() const
{
    if (rows_.empty())
        return false;
    const Row& last = rows_.back();
    const double least = *std::min_element(settings_.targets.begin(), settings_.targets.end());
    return last.cpu >= settings_.seconds ||
           (truth_ && kPercent * std::max(last.error, last.dark_error) <= least);
}

void Score::print_times_head(const Settings& settings)
{
    fmt::print("\n{:<20}", "cpu-seconds to");
    for (const char* part : {"", "dark "})
        for (const double target : settings.targets)
            fmt::print("{:>11}", fmt::format("{}{:g} %", part, target));
    fmt::print("\n");
}

void Score::print_times() const
{
    fmt::print("{:<20}", name_);
    for (double Row::*error : {&Row::error, &Row::dark_error})
        for (const double target : settings_.targets)
            fmt::print("{:>11}", time_to(target / kPercent, error));
    fmt::print("\n");
}

/// Processor time at which an error falls to `target`, interpolated in log-log between the rows on
/// both sides; an upper bound where the first row is below it.
std::string Score::time_to(double target, double Row::*error) const
{
    const auto below = std::find_if(rows_.begin(), rows_.end(),
                                    [&](const Row& row) { return row.*error <= target; });
    if (below == rows_.end())
        return "-";
    if (below == rows_.begin())
        return fmt::format("<{:.2f}", below->cpu);
    const Row &a = *(below - 1), &b = *below;
    if (!(b.*error > 0.0))  // no less than that is known of it
        return fmt::format("<{:.2f}", b.cpu);
    const double slope = std::log(b.cpu / a.cpu) / std::log(b.*error / a.*error);
    return fmt::format("{:.2f}", a.cpu * std::pow(target / a.*error, slope));
}

}  // namespace lumel::bench
