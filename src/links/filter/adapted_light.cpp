#include "links/filter/adapted_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "atlas/lumels/sides.h"

namespace lumel {
namespace {

/// Minimum light that an eye adapts to, relative to the mean of all but the brightest lumels.
constexpr double kFaintest = 0.02, kAllButBrightest = 0.99;
/// Neighbours: deviation and radius of their weights [lumels].
constexpr double kBellSpread = 2.0;
constexpr int kReach = 6;
/// Minimum weight of neighbours of a lumel that has any.
constexpr double kFewNeighbours = 0.05;

using Bell = std::array<double, 2 * kReach + 1>;

Bell bell()
{
    Bell weight{};
    double sum = 0.0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const double r = (double(k) - double(kReach)) / kBellSpread;
        sum += weight[k] = std::exp(-0.5 * r * r);
    }
    for (double& one : weight)
        one /= sum;
    return weight;
}

struct Sum {
    double light = 0.0, weight = 0.0;
};

/// [N] Weighted sums over lumels of the same chart and side along a step.
std::vector<Sum> blurred(const Lumels& lumels, std::span<const std::uint32_t> by_side,
                         const std::vector<Sum>& sums, const glm::ivec2& step)
{
    static const Bell weight = bell();
    std::vector<Sum> result(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const glm::ivec2 at(int(lumel.texel) % lumels.width, int(lumel.texel) / lumels.width);
        for (std::size_t k = 0; k < weight.size(); ++k) {
            const glm::ivec2 there = at + (int(k) - kReach) * step;
            const std::uint32_t j =
                lit_lumel_at(lumels, by_side, there.x, there.y, is_back(lumel) ? 1 : 0);
            if (j == kNoLumel || lumels.lumels[j].chart != lumel.chart)
                continue;
            result[i].light += weight[k] * sums[j].light;
            result[i].weight += weight[k] * sums[j].weight;
        }
    }
    return result;
}

/// [N] Means over the neighbours, without the lumel itself; -1: it has none.
std::vector<double> means_nearby(const Lumels& lumels, const std::vector<double>& light)
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(lumels);
    std::vector<Sum> sums;
    for (const double one : light)
        sums.push_back({one, 1.0});
    sums = blurred(lumels, by_side, sums, {1, 0});
    sums = blurred(lumels, by_side, sums, {0, 1});
    const double middle = bell()[kReach], own = middle * middle;
    std::vector<double> means(light.size(), -1.0);
    for (std::size_t i = 0; i < light.size(); ++i)
        if (const double weight = sums[i].weight - own; weight > kFewNeighbours)
            means[i] = std::max(sums[i].light - own * light[i], 0.0) / weight;
    return means;
}

/// Mean of all but the brightest.
double mean_of(std::vector<double> light)
{
    std::erase_if(light, [](double one) { return one < 0.0; });
    if (light.empty())
        return 0.0;
    const auto kept =
        std::max(std::ptrdiff_t(kAllButBrightest * double(light.size())), std::ptrdiff_t(1));
    std::nth_element(light.begin(), light.begin() + kept - 1, light.end());
    double sum = 0.0;
    for (std::ptrdiff_t i = 0; i < kept; ++i)
        sum += light[std::size_t(i)];
    return sum / double(kept);
}

/// [chart, side] Means.
std::vector<Sum> sums_of_charts(const Lumels& lumels, const std::vector<double>& light)
{
    std::vector<Sum> charts;
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        const std::size_t at = place_by_side(lumel.chart, is_back(lumel));
        if (lumel.flags & kLumelBuried)
            continue;
        if (charts.size() <= at)
            charts.resize(at + 1);
        charts[at].light += light[i];
        charts[at].weight += 1.0;
    }
    return charts;
}

}  // namespace

std::vector<double> adapted_light(const Lumels& lumels, const std::vector<double>& light)
{
    std::vector<double> nearby = means_nearby(lumels, light);
    const std::vector<Sum> charts = sums_of_charts(lumels, light);
    for (std::size_t i = 0; i < light.size(); ++i)
        if (lumels.lumels[i].flags & kLumelBuried)
            nearby[i] = -1.0;
    const double least = kFaintest * mean_of(nearby);
    std::vector<double> adapted(light.size(), 0.0);
    for (std::size_t i = 0; i < light.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        if (lumel.flags & kLumelBuried)
            continue;
        const Sum& chart = charts[place_by_side(lumel.chart, is_back(lumel))];
        adapted[i] = std::max({chart.light / chart.weight, nearby[i], least});
    }
    return adapted;
}

}  // namespace lumel
