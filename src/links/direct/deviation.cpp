#include "links/direct/deviation.h"

#include <algorithm>
#include <cstdlib>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"

namespace lumel {
namespace {

/// Maximum distance of neighbours in the order.
constexpr std::size_t kReachInOrder = 4;
/// Minimum neighbours on the chart.
constexpr double kEnough = 3.0;
/// Minimum neighbours that tell the deviation, counted as in tell(). Where few rays find a light,
/// most squares are 0, and the mean is of a few large ones.
constexpr double kEnoughThatTell = 12.0;
constexpr std::size_t kDeviationsPerTask = 1024;

template <class Value>
struct NearSquares {
    Value squares{0.0}, fourths{0.0};
    double count = 0.0;

    void add(const Value& square)
    {
        squares += square;
        fourths += square * square;
        count += 1.0;
    }
};

double least_of(double value)
{
    return value;
}

double least_of(const glm::dvec3& value)
{
    return std::min({value.x, value.y, value.z});
}

/// Whether enough neighbours tell all quantities. A mean of unequal squares is as certain as one of
/// (Σ square)² / Σ square² equal ones.
template <class Value>
bool tell(const NearSquares<Value>& sum)
{
    return least_of(sum.squares) > 0.0 &&
           least_of(sum.squares * sum.squares - kEnoughThatTell * sum.fourths) >= 0.0;
}

/// Over the neighbours of lumel i on its chart, ring by ring.
template <class Value>
NearSquares<Value> on_chart(const std::vector<Value>& square, const Lumels& lumels,
                            const std::vector<std::uint32_t>& by_side, std::uint32_t i,
                            NearReach reach)
{
    const Lumel& lumel = lumels.lumels[i];
    const int x = int(lumel.texel) % lumels.width, y = int(lumel.texel) / lumels.width;
    const int side = is_back(lumel) ? 1 : 0;
    NearSquares<Value> sum;
    for (int r = 1; r <= reach.least || (r <= reach.most && !tell(sum)); ++r)
        for (int dy = -r; dy <= r; ++dy)
            for (int dx = -r; dx <= r; dx += std::abs(dy) == r ? 1 : 2 * r) {
                const std::uint32_t j = lit_lumel_at(lumels, by_side, x + dx, y + dy, side);
                if (j != kNoLumel && lumels.lumels[j].chart == lumel.chart)
                    sum.add(square[j]);
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
        if (o != place)
            sum.add(square[order[o]]);
    return sum;
}

}  // namespace

template <class Value>
std::vector<Value> deviation_nearby(const std::vector<Value>& square, const Lumels& lumels,
                                    const std::vector<std::uint32_t>& order, NearReach reach,
                                    double own)
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
                                              const std::vector<std::uint32_t>&, NearReach, double);
template std::vector<glm::dvec3> deviation_nearby(const std::vector<glm::dvec3>&, const Lumels&,
                                                  const std::vector<std::uint32_t>&, NearReach,
                                                  double);

}  // namespace lumel
