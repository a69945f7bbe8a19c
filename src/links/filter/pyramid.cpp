#include "links/filter/pyramid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lumel {
namespace {

constexpr std::array<float, 4> kCautionIndirect = {0.5f, 0.5f, 0.5f, 0.5f};
constexpr std::array<float, 2> kCautionDirect = {1.0f, 0.5f};
/// Bounds on the amplitude of details, relative to (deviation of the fit / R)² × the light: second
/// order in the distance R of what sends it [WH92].
constexpr float kLeastDetail = 0.04f, kMostDetail = 4.0f;
constexpr float kUnbounded = std::numeric_limits<float>::max();
/// Deviation of the window over which gains are averaged [cells]; of the finest level.
constexpr float kGainSpread = 3.0f, kFinestGainSpread = 3.6f;
/// Deviations of the window for local noise [cells], of indirect and of direct light. A detail
/// above this multiple of that noise is taken for light.
constexpr float kNoiseSpreadIndirect = 1.5f, kNoiseSpreadDirect = 1.0f, kLocalCaution = 3.0f;
/// That multiple where the wide window has no signal above kTellingCaution × its noise.
constexpr float kLoneCaution = 5.0f, kTellingCaution = 0.75f;
/// Side up to which the noise of one cell can pass for signal [lumels].
constexpr int kFewLumels = 2;
/// Radius of the window in deviations.
constexpr float kGainRadius = 2.5f;

/// Classes of the distance to other geometry: 1, 2, 4 … lumels.
constexpr int kDistanceClasses = 6;
/// Cells of any distance that take part, in case few are alike.
constexpr float kUnlikeCells = 8.0f;

/// Averages of a level over cells nearby.
struct Moments {
    float signal = 0.0f, mean = 0.0f, bound = 0.0f, count = 0.0f;
    /// The most that one cell adds to the signal. Among many cells, chance makes a few bright in
    /// all estimates; they would pass for detail.
    float strongest = 0.0f;

    Moments& operator+=(const Moments& other)
    {
        strongest = std::max(strongest, other.strongest);
        signal += other.signal;
        mean += other.mean;
        bound += other.bound;
        count += other.count;
        return *this;
    }
    float noise() const { return std::max(mean - signal, 0.0f); }
    Moments operator*(float factor) const
    {
        return {factor * signal, factor * mean, factor * bound, factor * count, factor * strongest};
    }
};

/// Sums the moments of a lumel's details.
template <std::size_t Count>
Moments moments_of(const FitLight<Count>& detail, const FitLight<Count>& fitted, float bound)
{
    constexpr float kOfPairs = 0.5f * float(Count * (Count - 1));
    Moments moments{.count = 1.0f};
    float light = 0.0f;
    for (std::size_t c = 0; c < 3; ++c) {
        float sum = 0.0f, squares = 0.0f, all = 0.0f;
        for (std::size_t k = 0; k < Count; ++k) {
            const float d = detail[3 * k + c];
            sum += d;
            squares += d * d;
            all += fitted[3 * k + c];
        }
        moments.signal += 0.5f * (sum * sum - squares) / kOfPairs;
        moments.mean += sum * sum / float(Count * Count);
        light += all * all / float(Count * Count);
    }
    moments.bound = bound * bound * light;
    return moments;
}

/// Gaussian of a squared distance.
float bell_at(float squared, float spread)
{
    return std::exp(-0.5f * squared / (spread * spread));
}

/// Gaussian blur of rows or columns, in place.
void blur(std::vector<Moments>& cells, std::size_t lines, std::size_t length, std::size_t from_line,
          std::size_t from_cell, const std::vector<float>& bell)
{
    std::vector<Moments> line(length);
    for (std::size_t n = 0; n < lines; ++n) {
        Moments* first = &cells[n * from_line];
        for (std::size_t i = 0; i < length; ++i)
            line[i] = first[i * from_cell];
        for (std::size_t i = 0; i < length; ++i) {
            Moments sum = line[i] * bell[0];
            for (std::size_t r = 1; r < bell.size(); ++r) {
                if (i >= r)
                    sum += line[i - r] * bell[r];
                if (i + r < length)
                    sum += line[i + r] * bell[r];
            }
            first[i * from_cell] = sum;
        }
    }
}

void blur(std::vector<Moments>& cells, int width, int height, float spread)
{
    std::vector<float> bell;
    for (int r = 0; float(r) <= kGainRadius * spread; ++r)
        bell.push_back(bell_at(float(r * r), spread));
    const auto across = std::size_t(width), down = std::size_t(height);
    blur(cells, down, across, across, 1, bell);
    blur(cells, across, down, 1, across, bell);
}

/// Gain of a Wiener filter.
float wiener(float signal, float noise)
{
    return signal + noise > 0.0f ? signal / (signal + noise) : 1.0f;
}

/// next: sums over the window for local noise.
float gain_of(const Moments& sums, const Moments& next, const PyramidRule& rule, float caution)
{
    const float scale = next.count > 0.0f ? sums.count / next.count : 0.0f;
    const Moments here = next.count > 0.0f ? next * scale : sums;
    const float most = rule.is_bounded ? kMostDetail * kMostDetail * sums.bound : kUnbounded,
                least = rule.is_bounded ? kLeastDetail * kLeastDetail * sums.bound : 0.0f;
    const float doubted = rule.doubts_single_cells ? 1.0f : 0.0f;
    const bool is_lone = !(sums.signal - doubted * sums.strongest > kTellingCaution * sums.noise());
    const float stands_out =
        is_lone ? here.signal - here.strongest - kLoneCaution * here.noise()
                : here.signal - doubted * here.strongest - kLocalCaution * here.noise();
    const float local = std::clamp(stands_out, 0.0f, most),
                wide =
                    std::clamp(sums.signal - sums.strongest - caution * sums.noise(), least, most);
    return rule.has_local_noise ? wiener(std::max(wide, local), here.noise())
                                : std::max(wiener(wide, sums.noise()), wiener(local, here.noise()));
}

/// Weight of a distance [octaves] in a class of distances: of a linear interpolation.
float weight_in(int distance_class, float octaves)
{
    return std::max(1.0f - std::abs(octaves - float(distance_class)), 0.0f);
}

/// Averages over cells nearby that are alike in distance, as in a bilateral grid [CPD07]: noise of
/// lumels in contact must not pass for detail of open ones beside them. octaves: distance of each
/// cell to other geometry, 0…kDistanceClasses - 1.
std::vector<Moments> averaged(const std::vector<Moments>& cells, const std::vector<float>& octaves,
                              int width, int height, float spread)
{
    std::vector<Moments> all = cells, result(cells.size());
    blur(all, width, height, spread);
    for (int c = 0; c < kDistanceClasses; ++c) {
        std::vector<Moments> alike(cells.size());
        bool any = false;
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (const float weight = weight_in(c, octaves[i]);
                weight > 0.0f && cells[i].count > 0.0f) {
                alike[i] = cells[i] * weight;
                any = true;
            }
        if (!any)
            continue;
        blur(alike, width, height, spread);
        for (std::size_t i = 0; i < cells.size(); ++i)
            if (const float weight = weight_in(c, octaves[i]);
                weight > 0.0f && all[i].count > 0.0f) {
                result[i] += alike[i] * weight;
                result[i] += all[i] * (weight * kUnlikeCells / all[i].count);
            }
    }
    return result;
}

/// Gains of a level's cells.
template <std::size_t Count>
std::vector<float> gains_of(const FilterChart& chart, const FitLevel<Count>& level,
                            const std::vector<FitLight<Count>>& fitted,
                            const std::vector<FitLight<Count>>& detail, const PyramidRule& rule,
                            float caution)
{
    std::vector<Moments> cells(level.count.size());
    std::vector<float> octaves(cells.size(), 0.0f);
    const float spread = kFitSpread * float(level.side);
    for (int y = 0; y < chart.height; ++y)
        for (int x = 0; x < chart.width; ++x) {
            const std::size_t t = chart.at(x, y), cell = level.at(x / level.side, y / level.side);
            if (chart.lumel[t] == kNoLumel || !level.counts(cell))
                continue;
            const float reach = std::min(spread * chart.nearness[t], 1.0f);
            cells[cell] += moments_of<Count>(detail[t], fitted[t], reach * reach);
            if (rule.is_bounded)
                octaves[cell] += std::clamp(-std::log2(std::max(chart.nearness[t], 1e-9f)), 0.0f,
                                            float(kDistanceClasses - 1));
        }
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        octaves[cell] /= std::max(cells[cell].count, 1.0f);
        if (level.side <= kFewLumels)
            cells[cell].strongest = std::max(cells[cell].signal, 0.0f);
    }
    std::vector<Moments> next = cells;
    blur(next, level.width, level.height, rule.noise_spread);
    const std::vector<Moments> wide = averaged(cells, octaves, level.width, level.height,
                                               level.side == 1 ? kFinestGainSpread : kGainSpread);
    std::vector<float> gains(cells.size());
    for (std::size_t cell = 0; cell < gains.size(); ++cell)
        gains[cell] = gain_of(wide[cell], next[cell], rule, caution);
    return gains;
}

/// Bilinear between the centres of cells.
template <std::size_t Count>
float gain_at(const FitLevel<Count>& level, const std::vector<float>& gains, int x, int y)
{
    if (level.side == 1)
        return gains[level.at(x, y)];
    const glm::vec2 at = glm::clamp((glm::vec2(x, y) + 0.5f) / float(level.side) - 0.5f,
                                    glm::vec2(0.0f), glm::vec2(level.width - 1, level.height - 1));
    const int left = int(at.x), top = int(at.y), right = std::min(left + 1, level.width - 1),
              bottom = std::min(top + 1, level.height - 1);
    const glm::vec2 across = at - glm::vec2(left, top);
    return glm::mix(
        glm::mix(gains[level.at(left, top)], gains[level.at(right, top)], across.x),
        glm::mix(gains[level.at(left, bottom)], gains[level.at(right, bottom)], across.x),
        across.y);
}

}  // namespace

PyramidRule rule_of_indirect()
{
    return {.caution = kCautionIndirect,
            .is_bounded = true,
            .noise_spread = kNoiseSpreadIndirect,
            .has_local_noise = false,
            .doubts_single_cells = true};
}

PyramidRule rule_of_direct()
{
    return {.caution = kCautionDirect,
            .is_bounded = false,
            .noise_spread = kNoiseSpreadDirect,
            .has_local_noise = true,
            .doubts_single_cells = false};
}

namespace {

/// Filtered estimates: the fits of `levels` levels, from the finest on, and their details, by
/// gains. gains_of(l, level, fitted, detail): those of level l at each texel.
template <std::size_t Count, class GainsOf>
std::vector<FitLight<Count>> join_levels(const FilterChart& chart, FitLevel<Count> level,
                                         std::size_t levels, const GainsOf& gains_of)
{
    std::vector<FitLight<Count>> finer = level.light, result(finer.size(), FitLight<Count>{});
    for (std::size_t l = 0; l < levels; ++l) {
        if (l > 0)
            level = coarser_level(level);
        std::vector<FitLight<Count>> fitted = fitted_light(chart, level, finer);
        for (std::size_t t = 0; t < finer.size(); ++t)
            for (std::size_t c = 0; c < finer[t].size(); ++c)
                finer[t][c] -= fitted[t][c];
        const std::vector<FitLight<Count>>& detail = finer;
        const std::vector<float>& gains = gains_of(l, level, fitted, detail);
        for (std::size_t t = 0; t < result.size(); ++t)
            for (std::size_t c = 0; c < result[t].size(); ++c)
                result[t][c] += gains[t] * detail[t][c];
        finer = std::move(fitted);
    }
    for (std::size_t t = 0; t < finer.size(); ++t)
        for (std::size_t c = 0; c < result[t].size(); ++c)
            result[t][c] += finer[t][c];
    return result;
}

}  // namespace

template <std::size_t Count>
Filtered<Count> filter_chart(const FilterChart& chart,
                             const std::array<const Estimates*, Count>& found,
                             const PyramidRule& rule)
{
    FitLevel<Count> finest = finest_level<Count>(chart, found);
    Outliers outliers;
    if (rule.doubts_single_cells) {
        outliers = find_outliers<Count>(chart, finest.light);
        spread_outliers<Count>(chart, outliers, finest.light);
    }
    PyramidGains used(rule.caution.size(), std::vector<float>(chart.lumel.size(), 0.0f));
    const auto find_gains =
        [&](std::size_t l, const FitLevel<Count>& level, const std::vector<FitLight<Count>>& fitted,
            const std::vector<FitLight<Count>>& detail) -> const std::vector<float>& {
        const std::vector<float> gains =
            gains_of(chart, level, fitted, detail, rule, rule.caution[l]);
        for (int y = 0; y < chart.height; ++y)
            for (int x = 0; x < chart.width; ++x)
                used[l][chart.at(x, y)] = gain_at(level, gains, x, y);
        return used[l];
    };
    std::vector<FitLight<Count>> light =
        join_levels<Count>(chart, std::move(finest), rule.caution.size(), find_gains);
    return {std::move(light), std::move(outliers), std::move(used)};
}

std::vector<FitLight<kFilteredTogether>>
filter_chart_by(const Outliers& outliers, const PyramidGains& gains, const FilterChart& chart,
                const std::array<const Estimates*, kFilteredTogether>& found)
{
    FitLevel<kFilteredTogether> finest = finest_level<kFilteredTogether>(chart, found);
    spread_parts<kFilteredTogether>(chart, outliers, finest.light);
    return join_levels<kFilteredTogether>(
        chart, std::move(finest), gains.size(),
        [&](std::size_t l, const auto&, const auto&, const auto&) -> const std::vector<float>& {
            return gains[l];
        });
}

template Filtered<2> filter_chart<2>(const FilterChart&, const std::array<const Estimates*, 2>&,
                                     const PyramidRule&);
template Filtered<3> filter_chart<3>(const FilterChart&, const std::array<const Estimates*, 3>&,
                                     const PyramidRule&);

}  // namespace lumel
