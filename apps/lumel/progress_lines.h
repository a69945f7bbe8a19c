#pragma once
// Progress for other programs: JSON on stderr.

#include <chrono>
#include <string>

#include "jobs/solve/bake_options.h"

namespace lumel {

/// {"stage":"solving","fraction":0.53,"shots":24,"error":0.031,"seconds":1.2}; shots and error only
/// where they are known.
std::string progress_json(const BakeProgress& progress);

/// Prints such a line when a stage begins, then at most ten a second.
class ProgressLines {
public:
    void show(const BakeProgress& progress);

private:
    std::string stage_;
    std::chrono::steady_clock::time_point last_;
};

}  // namespace lumel
