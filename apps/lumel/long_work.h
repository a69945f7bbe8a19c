#pragma once
// Terminal output of long-running commands.

#include <functional>
#include <string>

#include "arguments.h"

namespace lumel {

/// Printed when the work has ended.
struct Conclusion {
    std::string report;    ///< JSON, with its line break
    std::string sentence;  ///< the same in a line for people
    bool interrupted = false;
};

/// "estimated error 2.25 % of the light around (8.72 % overall)", of two fractions.
std::string eye_error_text(double eye_error, double error);

/// Does long work: a progress line shows how far it is, Ctrl-C stops it early, and stdout
/// gets its conclusion as `talk` wants it. `batch`: shooters per iteration; 0 where nothing is
/// shot. Returns the exit code; throws what `work` throws.
int do_long_work(const Talk& talk, int batch,
                 const std::function<Conclusion(const ProgressFunction&)>& work);

}  // namespace lumel
