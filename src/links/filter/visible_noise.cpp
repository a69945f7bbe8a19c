#include "links/filter/visible_noise.h"

#include <algorithm>
#include <cmath>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"
#include "base/ranks/rank_blocks.h"
#include "links/filter/chart_places.h"

namespace lumel {
namespace {

/// Lumels count from this distance on to the rim of a chart, and to geometry on it [lumels].
constexpr int kFromRim = 3, kFromGeometry = 8;
/// Lumels below this open share of their area are partly covered by other geometry.
constexpr float kOpen = 0.999f;
/// Minimum number of such lumels of a chart: fewer do not show a pattern.
constexpr std::size_t kFewest = 400;
/// Noise is relative to the mean light over a Gaussian of this deviation [lumels].
constexpr float kSurroundings = 2.0f;
/// Charts below this fraction of the brightest are black.
constexpr double kBlack = 1e-4;
/// The worst chart that counts is the one below which this fraction of charts is.
constexpr double kMostCharts = 0.95;
/// Radius of a Gaussian, in deviations.
constexpr float kBellRadius = 4.0f;
/// Minimum size of a task: a large wall is blurred on all cores.
constexpr std::size_t kTexelsPerTask = 16384;

constexpr std::size_t kLevels = VisibleNoise::kBands + 1;
/// Deviations of the Gaussian means [lumels].
constexpr std::array<float, kLevels> kDeviations = {1.0f, 2.0f, 4.0f, 8.0f, 16.0f};

/// Values of a chart, row by row.
struct Grid {
    int width, height;
    std::vector<float> value;

    float& at(int x, int y) { return value[std::size_t(y) * std::size_t(width) + std::size_t(x)]; }
    const float* row(int y) const { return &value[std::size_t(y) * std::size_t(width)]; }
};

std::vector<float> gaussian(float deviation)
{
    const int radius = int(std::ceil(kBellRadius * deviation));
    std::vector<float> weight;
    float sum = 0.0f;
    for (int k = -radius; k <= radius; ++k) {
        const float r = float(k) / deviation;
        weight.push_back(std::exp(-0.5f * r * r));
        sum += weight.back();
    }
    for (float& one : weight)
        one /= sum;
    return weight;
}

/// Sums weighted by a Gaussian; zero beyond the grid.
Grid blurred(const Grid& grid, float deviation)
{
    const std::vector<float> weight = gaussian(deviation);
    const int radius = int(weight.size() / 2);
    Grid rows{grid.width, grid.height, std::vector<float>(grid.value.size(), 0.0f)};
    const auto weight_at = [&](int k) { return *(weight.begin() + radius + k); };
    const auto add_row = [&](const float* from, float* to, float by, int count) {
        for (int x = 0; x < count; ++x)
            to[x] += by * from[x];
    };
    Grid all{grid.width, grid.height, std::vector<float>(grid.value.size(), 0.0f)};
    const auto blur_row = [&](int y) {
        for (int k = std::max(-radius, -y); k <= std::min(radius, grid.height - 1 - y); ++k)
            add_row(grid.row(y + k), &rows.at(0, y), weight_at(k), grid.width);
        for (int k = -std::min(radius, grid.width - 1); k <= std::min(radius, grid.width - 1); ++k)
            add_row(&rows.at(std::max(k, 0), y), &all.at(std::max(-k, 0), y), weight_at(k),
                    grid.width - std::abs(k));
    };
    parallel_for(std::size_t(grid.height), kTexelsPerTask / std::size_t(grid.width),
                 [&](std::size_t first, std::size_t last) {
                     for (std::size_t y = first; y < last; ++y)
                         blur_row(int(y));
                 });
    return all;
}

/// [texels] Steps along rows and columns to the nearest marked texel, or beyond the grid if
/// is_rim_marked; at most `most`.
std::vector<int> steps_to(const NoiseChart& chart, const std::vector<char>& marked,
                          bool is_rim_marked, int most)
{
    std::vector<int> steps(marked.size(), most);
    const auto of = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= chart.width || y >= chart.height)
            return is_rim_marked ? 0 : most;
        return steps[chart.at(x, y)];
    };
    const auto visit = [&](int x, int y) {
        int& here = steps[chart.at(x, y)];
        here = marked[chart.at(x, y)] ? 0
                                      : std::min({here, of(x - 1, y) + 1, of(x + 1, y) + 1,
                                                  of(x, y - 1) + 1, of(x, y + 1) + 1});
    };
    for (int y = 0; y < chart.height; ++y)
        for (int x = 0; x < chart.width; ++x)
            visit(x, y);
    for (int y = chart.height - 1; y >= 0; --y)
        for (int x = chart.width - 1; x >= 0; --x)
            visit(x, y);
    return steps;
}

/// [texels] 1 where noise counts.
Grid open_surface(const NoiseChart& chart)
{
    std::vector<char> outside(chart.lumel.size());
    for (std::size_t t = 0; t < outside.size(); ++t)
        outside[t] = chart.lumel[t] == kNoLumel;
    const std::vector<int> rim = steps_to(chart, outside, true, kFromRim + 1),
                           blocked = steps_to(chart, chart.is_blocked, false, kFromGeometry + 1);
    Grid open{chart.width, chart.height, std::vector<float>(outside.size())};
    for (std::size_t t = 0; t < outside.size(); ++t)
        open.value[t] = rim[t] > kFromRim && blocked[t] > kFromGeometry ? 1.0f : 0.0f;
    return open;
}

/// [bands][texels]
using Bands = std::array<std::vector<float>, VisibleNoise::kBands>;

/// Gaussian means over the open surface.
class Pyramid {
public:
    explicit Pyramid(const Grid& open) : open_(open)
    {
        for (std::size_t l = 0; l < kLevels; ++l)
            weight_[l] = next(l, l == 0 ? open : weight_[l - 1]);
    }

    /// Bands of values that are zero where the surface is not open.
    Bands bands(Grid values) const
    {
        Bands result;
        if (std::ranges::all_of(values.value, [](float one) { return one == 0.0f; })) {
            result.fill(values.value);
            return result;
        }
        std::vector<float> finer, mean(values.value.size());
        for (std::size_t l = 0; l < kLevels; ++l) {
            values = next(l, values);
            for (std::size_t t = 0; t < mean.size(); ++t)
                mean[t] = open_.value[t] > 0.0f ? values.value[t] / weight_[l].value[t] : 0.0f;
            if (l > 0) {
                result[l - 1].resize(mean.size());
                for (std::size_t t = 0; t < mean.size(); ++t)
                    result[l - 1][t] = finer[t] - mean[t];
            }
            finer = mean;
        }
        return result;
    }

private:
    /// A level from the one before it: Gaussians convolve to a Gaussian.
    static Grid next(std::size_t l, const Grid& before)
    {
        const float own = kDeviations[l], had = l == 0 ? 0.0f : kDeviations[l - 1];
        return blurred(before, std::sqrt(own * own - had * had));
    }

    const Grid& open_;
    std::array<Grid, kLevels> weight_;
};

double mean_product(const std::vector<float>& a, const std::vector<float>& b, std::size_t count)
{
    double sum = 0.0;
    for (std::size_t t = 0; t < a.size(); ++t)
        sum += double(a[t]) * double(b[t]);
    return sum / double(count);
}

/// Power of a mean's noise and bias. bands_of: returns Bands of a function of the lumel. count: of
/// lumels.
template <class BandsOf>
NoisePower power_of(const Mean& mean, const BandsOf& bands_of, std::size_t count)
{
    NoisePower power{};
    for (int k = 0; k < 2; ++k) {
        const Bands apart = bands_of([&](std::size_t i) { return mean.apart[i][k]; });
        for (std::size_t b = 0; b < apart.size(); ++b)
            power[b] += mean_product(apart[b], apart[b], count);
    }
    std::array<Bands, 3> bend;
    for (int k = 0; k < 3; ++k)
        bend[std::size_t(k)] = bands_of([&](std::size_t i) { return mean.bend[i][k]; });
    for (std::size_t b = 0; b < VisibleNoise::kBands; ++b) {
        double products = 0.0;
        for (std::size_t k = 0; k < bend.size(); ++k)
            products += mean_product(bend[k][b], bend[(k + 1) % bend.size()][b], count);
        power[b] += std::max(0.0, products / double(bend.size()));
    }
    return power;
}

/// The chart at a place. by_side: lumels_by_side().
NoiseChart chart_at(const ChartPlace& place, const SolveScene& scene,
                    const std::vector<std::uint32_t>& by_side)
{
    const glm::ivec2 size = place.high - place.low + 1;
    NoiseChart chart{.width = size.x, .height = size.y};
    for (int y = place.low.y; y <= place.high.y; ++y)
        for (int x = place.low.x; x <= place.high.x; ++x) {
            const std::size_t texel =
                std::size_t(y) * std::size_t(scene.lumels.width) + std::size_t(x);
            const std::uint32_t i = by_side[place_by_side(texel, place.is_back)];
            const bool is_there = i != kNoLumel && scene.lumels.lumels[i].chart == place.chart;
            chart.lumel.push_back(is_there ? i : kNoLumel);
            chart.is_blocked.push_back(is_there && scene.open[i] < kOpen);
        }
    return chart;
}

}  // namespace

double ChartNoise::power_in(std::size_t band) const
{
    double sum = 0.0;
    for (const NoisePower& one : power)
        sum += one[band];
    return sum;
}

std::size_t ChartNoise::worst_band() const
{
    std::size_t worst = 0;
    for (std::size_t b = 1; b < VisibleNoise::kBands; ++b)
        if (power_in(b) > power_in(worst))
            worst = b;
    return worst;
}

ChartNoise chart_noise(const NoiseChart& chart, const std::vector<float>& light,
                       const std::vector<const Mean*>& of)
{
    const Grid open = open_surface(chart);
    ChartNoise noise;
    for (std::size_t t = 0; t < open.value.size(); ++t) {
        if (open.value[t] > 0.0f)
            noise.lumels.push_back(chart.lumel[t]);
        else if (chart.lumel[t] != kNoLumel && !chart.is_blocked[t])
            noise.beside.push_back(chart.lumel[t]);
    }
    const std::size_t count = noise.lumels.size();
    if (count < kFewest)
        return {};
    const auto values = [&](const auto& of_lumel) {
        Grid grid{chart.width, chart.height, std::vector<float>(open.value.size(), 0.0f)};
        for (std::size_t t = 0; t < open.value.size(); ++t)
            if (open.value[t] > 0.0f)
                grid.value[t] = of_lumel(t);
        return grid;
    };
    const Grid own = values([&](std::size_t t) { return light[chart.lumel[t]]; });
    for (const float one : own.value)
        noise.light += double(one) / double(count);
    if (!(noise.light > 0.0))
        return {};
    const Grid around = blurred(own, kSurroundings), weight = blurred(open, kSurroundings);
    std::vector<float> relative(own.value.size(), 0.0f);
    for (std::size_t t = 0; t < relative.size(); ++t)
        if (open.value[t] > 0.0f)
            relative[t] = 1.0f / std::max(around.value[t] / weight.value[t],
                                          kFaintestAround * float(noise.light));
    const Pyramid pyramid(open);
    const auto bands_of = [&](const auto& of_lumel) {
        return pyramid.bands(
            values([&](std::size_t t) { return relative[t] * of_lumel(chart.lumel[t]); }));
    };
    for (const Mean* mean : of)
        noise.power.push_back(power_of(*mean, bands_of, count));
    return noise;
}

std::vector<ChartNoise> in_order(std::vector<ChartNoise> charts)
{
    double brightest = 0.0;
    for (const ChartNoise& chart : charts)
        brightest = std::max(brightest, chart.light);
    std::erase_if(charts, [&](const ChartNoise& chart) {
        return chart.lumels.empty() || chart.light < kBlack * brightest;
    });
    std::ranges::stable_sort(
        charts, {}, [](const ChartNoise& chart) { return chart.power_in(chart.worst_band()); });
    return charts;
}

std::size_t worst_that_counts(const std::vector<ChartNoise>& charts)
{
    const auto size = [](const ChartNoise& chart) {
        return std::sqrt(double(chart.lumels.size()));
    };
    double all = 0.0, below = 0.0;
    for (const ChartNoise& chart : charts)
        all += size(chart);
    for (std::size_t n = 0; n < charts.size(); ++n) {
        below += size(charts[n]);
        if (below >= kMostCharts * all)
            return n;
    }
    return 0;
}

VisibleNoise visible_noise(const std::vector<ChartNoise>& charts)
{
    VisibleNoise result;
    if (charts.empty())
        return result;
    double all = 0.0;
    for (const ChartNoise& chart : charts) {
        const auto lumels = double(chart.lumels.size());
        all += lumels;
        for (std::size_t b = 0; b < result.bands.size(); ++b)
            result.bands[b] += lumels * chart.power_in(b);
    }
    for (double& band : result.bands)
        band = std::sqrt(band / all);
    const ChartNoise& worst = charts[worst_that_counts(charts)];
    result.worst_chart = std::sqrt(worst.power_in(worst.worst_band()));
    return result;
}

std::vector<ChartNoise> noise_of_charts(const SolveScene& scene, const std::vector<float>& light,
                                        const std::vector<const Mean*>& of, Ranks* ranks)
{
    const std::vector<std::uint32_t> by_side = lumels_by_side(scene.lumels);
    const std::vector<ChartPlace> places = chart_places(scene.lumels);
    std::vector<ChartNoise> charts(places.size());
    parallel_for_own(ranks, 0, places.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n)
            charts[n] = chart_noise(chart_at(places[n], scene, by_side), light, of);
    });
    share_blocks(ranks, 0, places.size(),
                 [&](auto& archive, std::size_t n) { archive(charts[n]); });
    return in_order(std::move(charts));
}

}  // namespace lumel
