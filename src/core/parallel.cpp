#include "core/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace lumel {

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body)
{
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, grain > 0 ? grain : 1),
        [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
}

}  // namespace lumel
