#pragma once
// Parallel loops over all cores. Results must not depend on the order of the calls.

#include <cstddef>
#include <functional>
#include <string>

namespace lumel {

/// Calls body(first, last) on disjoint ranges that together cover [0, count), on all cores. `grain`
/// is the minimum range per task. Rethrows exceptions of `body`.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t first, std::size_t last)>& body);

/// Runs the loop in steps of at most `step`. After each, go_on(done) receives the number done and
/// returns false to stop. Returns false if stopped.
bool parallel_steps(std::size_t count, std::size_t step, std::size_t grain,
                    const std::function<void(std::size_t first, std::size_t last)>& body,
                    const std::function<bool(std::size_t done)>& go_on);

/// Version of oneTBB, which runs the loops.
std::string tbb_version();

}  // namespace lumel
