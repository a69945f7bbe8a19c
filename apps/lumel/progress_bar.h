#pragma once
// One line at the terminal that shows how far a bake is.

#include <chrono>
#include <string>

#include "jobs/solve/bake_options.h"

namespace lumel {

/// The text of the line, at most `width` columns: stage, bar, speed, estimated error, time left.
/// `batch`: shooters per iteration; 0 where nothing is shot.
std::string progress_line(const BakeProgress& progress, int batch, int width);

/// Draws the line on stderr over and over, and wipes it in the end. Draws nothing if `wanted` is
/// false or stderr is not a terminal.
class ProgressBar {
public:
    ProgressBar(bool wanted, int batch);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(const BakeProgress& progress);
    void clear();

private:
    bool drawn_ = false;
    bool shown_;
    int batch_;
    std::string stage_;
    std::chrono::steady_clock::time_point last_;
};

}  // namespace lumel
