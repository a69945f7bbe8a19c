#pragma once
// One loop over all cores. Results must not depend on the order of the calls.

#include <cstddef>
#include <functional>

namespace lumel {

/// Calls body(first, last) on disjoint ranges that together cover [0, count), on all cores.
/// `grain` is the smallest range worth a task. Exceptions of body reach the caller.
void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t first, std::size_t last)>& body);

}  // namespace lumel
