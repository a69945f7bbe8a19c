#include "base/core/parallel.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/version.h>

namespace lumel {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body)
{
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain > 0 ? grain : 1),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

bool parallel_steps(std::size_t count, std::size_t step, std::size_t grain,
                    const std::function<void(std::size_t, std::size_t)>& body,
                    const std::function<bool(std::size_t)>& go_on)
{
    for (std::size_t begin = 0, end; begin < count; begin = end) {
        end = std::min(begin + step, count);
        parallel_for(end - begin, grain, [&](std::size_t first, std::size_t last) {
            body(begin + first, begin + last);
        });
        if (!go_on(end))
            return false;
    }
    return true;
}

std::string tbb_version()
{
    return TBB_runtime_version();
}

}  // namespace lumel
