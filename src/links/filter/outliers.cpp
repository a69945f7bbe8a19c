#include "links/filter/outliers.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "base/core/luminance.h"

namespace lumel {
namespace {

/// Multiple of the light around, above which light of one estimate is an outlier.
constexpr float kOutlier = 8.0f;
/// Lumels from which the light around is found; and the next ones, with the lumel itself.
constexpr std::size_t kAround = 256, kNext = 9;
/// Fraction that a shared outlier adds to the light around; and the most lumels that share one.
constexpr float kAdded = 0.02f;
constexpr float kMostLumels = 4096.0f;

/// Finds the lumels nearest to one, along open steps.
class NearbyLumels {
public:
    explicit NearbyLumels(const FilterChart& chart) : chart_(&chart), seen_(chart.lumel.size(), 0)
    {
    }

    /// At most `count` texels, from the lumel itself on.
    const std::vector<std::uint32_t>& of(std::uint32_t texel, std::size_t count)
    {
        ++call_;
        found_.assign(1, texel);
        seen_[texel] = call_;
        for (std::size_t n = 0; n < found_.size() && found_.size() < count; ++n) {
            const int x = int(found_[n]) % chart_->width, y = int(found_[n]) / chart_->width;
            for (const Offset& step : kSteps)
                for (const int sign : {1, -1}) {
                    const int dx = sign * step.x, dy = sign * step.y;
                    if (!chart_->is_open(x, y, dx, dy) || found_.size() == count)
                        continue;
                    const std::size_t to = chart_->at(x + dx, y + dy);
                    if (seen_[to] != call_) {
                        seen_[to] = call_;
                        found_.push_back(std::uint32_t(to));
                    }
                }
        }
        return found_;
    }

private:
    const FilterChart* chart_;
    std::vector<std::uint32_t> seen_;  ///< by which call
    std::uint32_t call_ = 0;
    std::vector<std::uint32_t> found_;
};

/// Mean luminance of estimates at some lumels, without estimate k of the first.
template <std::size_t Count>
float mean_beside(const std::vector<std::array<float, Count>>& light,
                  const std::vector<std::uint32_t>& texels, std::size_t count, std::size_t k)
{
    float sum = -light[texels[0]][k];
    for (std::size_t n = 0; n < count; ++n)
        for (const float one : light[texels[n]])
            sum += one;
    return sum / float(Count * count - 1);
}

template <std::size_t Count>
float mean_of(const std::array<float, Count>& light)
{
    return std::accumulate(light.begin(), light.end(), 0.0f) / float(Count);
}

/// level: of the light around, relative to the outlier.
template <std::size_t Count>
Outlier outlier_at(const std::vector<FitLight<Count>>& light, std::uint32_t texel, std::size_t k,
                   float level)
{
    const float share = 1.0f - level;
    const float spread =
        level > 0.0f ? std::min(share / (float(Count) * kAdded * level), kMostLumels) : kMostLumels;
    glm::vec3 sum(0.0f), of_sum(0.0f);
    for (std::size_t other = 0; other < Count; ++other)
        sum += estimate_of<Count>(light[texel], other);
    const glm::vec3 shared = share * estimate_of<Count>(light[texel], k);
    for (glm::length_t c = 0; c < 3; ++c)
        of_sum[c] = sum[c] > 0.0f ? shared[c] / sum[c] : 0.0f;
    return {.texel = texel,
            .estimate = std::uint32_t(k),
            .spread = std::uint32_t(spread),
            .share = share,
            .of_sum = of_sum};
}

/// Light that a lumel gives to those around.
struct GivenLight {
    std::uint32_t texel, spread, first;  ///< first of three channels
    glm::vec3 light;
};

/// luminance: Outliers::luminance.
template <std::size_t Count>
void give(const FilterChart& chart, const std::vector<GivenLight>& given,
          const std::vector<float>& luminance, std::vector<FitLight<Count>>& light)
{
    if (given.empty())
        return;
    NearbyLumels nearby(chart);
    for (const GivenLight& one : given) {
        const std::vector<std::uint32_t>& around = nearby.of(one.texel, one.spread);
        float sum = 0.0f;
        for (const std::uint32_t t : around)
            sum += luminance[t];
        if (!(sum > 0.0f))
            continue;
        for (glm::length_t c = 0; c < 3; ++c) {
            const std::size_t channel = one.first + std::size_t(c);
            light[one.texel][channel] -= one.light[c];
            for (const std::uint32_t t : around)
                light[t][channel] += one.light[c] * (luminance[t] / sum);
        }
    }
}

}  // namespace

template <std::size_t Count>
Outliers find_outliers(const FilterChart& chart, const std::vector<FitLight<Count>>& light)
{
    std::vector<std::array<float, Count>> bright(light.size());
    for (std::size_t t = 0; t < light.size(); ++t)
        for (std::size_t k = 0; k < Count; ++k)
            bright[t][k] = float(luminance(estimate_of<Count>(light[t], k)));
    NearbyLumels nearby(chart);
    Outliers outliers;
    for (std::uint32_t t = 0; t < light.size(); ++t)
        for (std::size_t k = 0; k < Count && chart.lumel[t] != kNoLumel; ++k) {
            const float here = bright[t][k],
                        others = (float(Count) * mean_of<Count>(bright[t]) - here) / (Count - 1);
            if (!(here > kOutlier * others))
                continue;
            const std::vector<std::uint32_t>& around = nearby.of(t, kAround);
            if (around.size() < kNext)
                continue;
            const float level = std::max(mean_beside<Count>(bright, around, kNext, k),
                                         mean_beside<Count>(bright, around, around.size(), k));
            float brightest = level;
            for (std::size_t n = 1; n < kNext; ++n)
                brightest = std::max(brightest, mean_of<Count>(bright[around[n]]));
            if (here > kOutlier * brightest)
                outliers.all.push_back(outlier_at<Count>(light, t, k, level / here));
        }
    if (outliers.all.empty())
        return outliers;
    for (const std::array<float, Count>& one : bright)
        outliers.luminance.push_back(mean_of<Count>(one));
    for (const Outlier& one : outliers.all)
        outliers.luminance[one.texel] -= one.share * bright[one.texel][one.estimate] / float(Count);
    return outliers;
}

template <std::size_t Count>
void spread_outliers(const FilterChart& chart, const Outliers& outliers,
                     std::vector<FitLight<Count>>& light)
{
    std::vector<GivenLight> given;
    for (const Outlier& one : outliers.all)
        given.push_back({one.texel, one.spread, 3 * one.estimate,
                         one.share * estimate_of<Count>(light[one.texel], one.estimate)});
    give<Count>(chart, given, outliers.luminance, light);
}

template <std::size_t Count>
void spread_parts(const FilterChart& chart, const Outliers& outliers,
                  std::vector<FitLight<Count>>& parts)
{
    std::vector<GivenLight> given;
    for (const Outlier& one : outliers.all)
        for (std::size_t k = 0; k < Count; ++k)
            given.push_back({one.texel, one.spread, std::uint32_t(3 * k),
                             one.of_sum * estimate_of<Count>(parts[one.texel], k)});
    give<Count>(chart, given, outliers.luminance, parts);
}

template Outliers find_outliers<2>(const FilterChart&, const std::vector<FitLight<2>>&);
template void spread_outliers<2>(const FilterChart&, const Outliers&, std::vector<FitLight<2>>&);
template Outliers find_outliers<3>(const FilterChart&, const std::vector<FitLight<3>>&);
template void spread_outliers<3>(const FilterChart&, const Outliers&, std::vector<FitLight<3>>&);
template void spread_parts<8>(const FilterChart&, const Outliers&, std::vector<FitLight<8>>&);

}  // namespace lumel
