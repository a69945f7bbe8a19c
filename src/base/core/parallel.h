#pragma once
// One loop over all cores. Results must not depend on the order of the calls.

#include <cstddef>
#include <functional>
#include <string>

namespace lumel {

/// Calls body(first, last) on disjoint ranges that together cover [0, count), on all cores.
/// `grain` is the smallest range worth a task. Exceptions of body reach the caller.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t first, std::size_t last)>& body);

/// The same for work that is watched, a step of at most `step` at a time: after each, go_on(done)
/// receives the number that is done, and returns false to stop. Returns false if it stopped.
bool parallel_steps(std::size_t count, std::size_t step, std::size_t grain,
                    const std::function<void(std::size_t first, std::size_t last)>& body,
                    const std::function<bool(std::size_t done)>& go_on);

/// Of the library that runs the loops.
std::string tbb_version();

}  // namespace lumel
