#include "links/direct/deviation.h"

#include <algorithm>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Maximum distance of neighbours in the order.
constexpr std::size_t kReachInOrder = 4;
/// Minimum neighbours on the chart.
constexpr double kEnough = 3.0;
constexpr std::size_t kDeviationsPerTask = 1024;

template <class Value>
struct NearSquares {
    Value squares{0.0};
    double count = 0.0;
};

/// Over the neighbours of lumel i on its chart.
template <class Value>
NearSquares<Value> on_chart(const std::vector<Value>& square, const Lumels& lumels,
                            const std::vector<std::uint32_t>& by_side, std::uint32_t i, int reach)
{
    const Lumel& lumel = lumels.lumels[i];
    const int x = int(lumel.texel) % lumels.width, y = int(lumel.texel) / lumels.width;
    const int side = is_back(lumel) ? 1 : 0;
    NearSquares<Value> sum;
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
template <class Value>
NearSquares<Value> in_order(const std::vector<Value>& square,
                            const std::vector<std::uint32_t>& order, std::size_t place)
{
    NearSquares<Value> sum;
    const std::size_t end = std::min(place + kReachInOrder + 1, order.size());
    for (std::size_t o = place - std::min(place, kReachInOrder); o < end; ++o)
        if (o != place) {
            sum.squares += square[order[o]];
            sum.count += 1.0;
        }
    return sum;
}

}  // namespace

template <class Value>
std::vector<Value> deviation_nearby(const std::vector<Value>& square, const Lumels& lumels,
                                    const std::vector<std::uint32_t>& order, int reach, double own)
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(lumels);
    std::vector<Value> deviation(order.size());
    parallel_for(order.size(), kDeviationsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t o = first; o < last; ++o) {
            const std::uint32_t i = order[o];
            NearSquares<Value> sum = on_chart(square, lumels, by_side, i, reach);
            if (sum.count < kEnough)
                sum = in_order(square, order, o);
            deviation[i] =
                glm::sqrt((sum.squares + own * square[i]) / std::max(sum.count + own, 1.0));
        }
    });
    return deviation;
}

template std::vector<double> deviation_nearby(const std::vector<double>&, const Lumels&,
                                              const std::vector<std::uint32_t>&, int, double);
template std::vector<glm::dvec3> deviation_nearby(const std::vector<glm::dvec3>&, const Lumels&,
                                                  const std::vector<std::uint32_t>&, int, double);

}  // namespace lumel
