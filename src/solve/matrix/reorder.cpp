#include "solve/matrix/reorder.h"

#include <algorithm>
#include <limits>

#include "solve/matrix/blas.h"

namespace lumel {

// |a − b|² = |a|² − 2 a·b + |b|², all products at once.
std::vector<std::uint32_t> order_by_likeness(std::span<const float> rows, std::uint32_t count,
                                             std::uint32_t length)
{
    std::vector<float> products(std::size_t(count) * count);
    blas::product({rows, count, length}, blas::transposed(rows, count, length), products);

    std::vector<std::uint32_t> order, left(count);
    order.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i)
        left[i] = i;
    std::size_t next = 0;
    while (!left.empty()) {
        const std::uint32_t row = left[next];
        order.push_back(row);
        left.erase(left.begin() + std::ptrdiff_t(next));  // keeps their order, for equal distances
        float least = std::numeric_limits<float>::infinity();
        for (std::size_t k = 0; k < left.size(); ++k) {
            const std::size_t other = left[k];
            const float distance =
                products[other * count + other] - 2.0f * products[std::size_t(row) * count + other];
            if (distance < least) {
                least = distance;
                next = k;
            }
        }
    }
    return order;
}

}  // namespace lumel
