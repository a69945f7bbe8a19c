#include "links/direct/deviation.h"

#include <algorithm>
#include <cmath>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Maximum distance of neighbours in the order.
constexpr std::size_t kReachInOrder = 4;
/// Minimum neighbours on the chart.
constexpr double kEnough = 3.0;
constexpr std::size_t kDeviationsPerTask = 1024;

struct NearSquares {
    double squares = 0.0, count = 0.0;
};

/// Over the neighbours of lumel i on its chart.
NearSquares on_chart(const std::vector<double>& square, const Lumels& lumels,
                     const std::vector<std::uint32_t>& by_side, std::uint32_t i, int reach)
{
    const Lumel& lumel = lumels.lumels[i];
    const int x = int(lumel.texel) % lumels.width, y = int(lumel.texel) / lumels.width;
    const int side = is_back(lumel) ? 1 : 0;
    NearSquares sum;
    for (int dy = -reach; dy <= reach; ++dy)
        for (int dx = -reach; dx <= reach; ++dx) {
            const std::uint32_t j = lit_lumel_at(lumels, by_side, x + dx, y + dy, side);
            if (j == kNoLumel || j == i || lumels.lumels[j].chart != lumel.chart)
                continue;
            sum.squares += square[j];
            sum.count += 1.0;
        }
    return sum;
}

/// Over the lumels near `place` in the order, without the one there.
NearSquares in_order(const std::vector<double>& square, const std::vector<std::uint32_t>& order,
                     std::size_t place)
{
    NearSquares sum;
    const std::size_t end = std::min(place + kReachInOrder + 1, order.size());
    for (std::size_t o = place - std::min(place, kReachInOrder); o < end; ++o)
        if (o != place) {
            sum.squares += square[order[o]];
            sum.count += 1.0;
        }
    return sum;
}

}  // namespace

std::vector<double> deviation_nearby(const std::vector<double>& square, const Lumels& lumels,
                                     const std::vector<std::uint32_t>& order, int reach, double own)
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(lumels);
    std::vector<double> deviation(order.size());
    parallel_for(order.size(), kDeviationsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t o = first; o < last; ++o) {
            const std::uint32_t i = order[o];
            NearSquares sum = on_chart(square, lumels, by_side, i, reach);
            if (sum.count < kEnough)
                sum = in_order(square, order, o);
            deviation[i] =
                std::sqrt((sum.squares + own * square[i]) / std::max(sum.count + own, 1.0));
        }
    });
    return deviation;
}

}  // namespace lumel
