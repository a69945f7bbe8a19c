#pragma once
// The figures that `lumel-papers all` makes.

#include <span>

namespace lumel::bench {

enum class Extent {
    tiny,      ///< for tests
    standard,  ///< under an hour on two cores
    full,      ///< the papers' own sizes
};

/// One command line, for each extent; {out} stands for the page's folder.
struct Run {
    const char* key;    ///< by which the papers' numbers find its tables
    const char* title;  ///< heading on the page
    const char* what;   ///< what was timed, and what state errors are of
    const char* standard;
    const char* full;
    const char* tiny;

    const char* command(Extent extent) const
    {
        return extent == Extent::full ? full : extent == Extent::tiny ? tiny : standard;
    }
};

/// In the order in which they are made.
std::span<const Run> all_runs();

}  // namespace lumel::bench
