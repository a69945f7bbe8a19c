#pragma once
// The table of the scoreboard.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/settings.h"
#include "bench/stopwatch.h"
#include "bench/truth.h"

namespace lumel::bench {

/// Where a method stands.
struct Standing {
    std::uint64_t samples = 0;
    // Errors that the method states itself, < 0: it states none.
    double error = -1.0;
    double dark_error = -1.0;
};

/// The rows of one method, printed as they come.
class Score {
public:
    /// What is given must outlive it.
    Score(std::string name, const Settings& settings, const std::optional<Truth>& truth);

    static void print_head();

    void add_row(const Standing& standing, const Stopwatch& watch,
                 const std::vector<glm::vec3>& light);

    /// No more rows are wanted: every target is reached, or time is up.
    bool has_ended() const;
    /// Would a row that costs so much take too long?
    bool can_afford(double cpu_seconds) const { return cpu_seconds <= settings_.seconds; }

    /// One line of the processor times to each target.
    static void print_times_head(const Settings& settings);
    void print_times() const;

private:
    struct Row {
        double cpu, error, dark_error;
    };

    std::string time_to(double target, double Row::*error) const;

    std::string name_;
    const Settings& settings_;
    const std::optional<Truth>& truth_;
    std::vector<Row> rows_;
};

}  // namespace lumel::bench
