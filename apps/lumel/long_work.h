#pragma once
// What the commands that take their time have in common at the terminal.

#include <functional>
#include <string>

#include "arguments.h"

namespace lumel {

/// What is printed at its end.
struct Conclusion {
    std::string report;    ///< JSON, with its line break
    std::string sentence;  ///< the same in a line for people
    bool interrupted = false;
};

/// Does long work: a progress line shows how far it is, Ctrl-C stops it early, and stdout
/// gets its conclusion as `talk` wants it. `batch`: shooters per iteration; 0 where nothing is
/// shot. Returns the exit code; throws what `work` throws.
int do_long_work(const Talk& talk, int batch,
                 const std::function<Conclusion(const ProgressFunction&)>& work);

}  // namespace lumel
