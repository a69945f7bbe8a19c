#pragma once
// All figures in one run.

#include <string>
#include <vector>

#include "bench/papers/runs.h"

namespace lumel::bench {

struct AllSettings {
    std::string folder;  ///< for papers.html and the pictures
    Extent extent = Extent::standard;
    std::vector<std::string> figures;  ///< keys of runs; empty: all
};

/// Makes the figures one after the other, and the page anew after each. A figure that fails is
/// named on the page, and the others go on. Progress goes to stderr. Returns false if one failed.
/// Throws Error for a folder that cannot be written and for a figure that there is not.
bool make_all(const AllSettings& settings);

}  // namespace lumel::bench
