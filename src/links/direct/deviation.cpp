#include "links/direct/deviation.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Neighbours on each side.
constexpr std::size_t kNeighbours = 4;

}  // namespace

std::vector<double> deviation_nearby(const std::vector<double>& square,
                                     const std::vector<std::uint32_t>& order, double own)
{
    const std::size_t count = order.size();
    std::vector<double> running(count + 1, 0.0), deviation(count);
    for (std::size_t o = 0; o < count; ++o)
        running[o + 1] = running[o] + square[order[o]];
    for (std::size_t o = 0; o < count; ++o) {
        const std::size_t first = o - std::min(o, kNeighbours);
        const std::size_t last = std::min(o + kNeighbours + 1, count);
        const double others = running[last] - running[first] - (running[o + 1] - running[o]);
        const double sum = std::max(others, 0.0) + own * square[order[o]];
        deviation[order[o]] = std::sqrt(sum / std::max(double(last - first - 1) + own, 1.0));
    }
    return deviation;
}

}  // namespace lumel
