#include "links/filter/filter.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "atlas/lumels/sides.h"
#include "base/core/luminance.h"
#include "base/ranks/rank_blocks.h"

namespace lumel {
namespace {

constexpr std::size_t kLumelsPerTask = 256;
/// Direct light within this distance of a lumel whose halves differ is filtered [lumels].
constexpr int kUncertainReach = 2;
/// Radius of the square over which nearness is averaged [lumels].
constexpr int kNearnessReach = 2;

/// Kinds of lumels that the filter treats alike: classes of nearness, and of the lumels of a chart,
/// each a factor of 2 and of 4 wide.
constexpr int kNearnessClasses = 8, kSizeClasses = 8;

/// Mean over the square around each lumel of the chart.
std::vector<float> smoothed(const FilterChart& chart, const std::vector<float>& value, int reach)
{
    std::vector<float> result(value.size(), 0.0f);
    for (int y = 0; y < chart.height; ++y)
        for (int x = 0; x < chart.width; ++x) {
            float sum = 0.0f, count = 0.0f;
            for (int ny = std::max(y - reach, 0); ny <= std::min(y + reach, chart.height - 1); ++ny)
                for (int nx = std::max(x - reach, 0); nx <= std::min(x + reach, chart.width - 1);
                     ++nx)
                    if (chart.lumel[chart.at(nx, ny)] != kNoLumel) {
                        sum += value[chart.at(nx, ny)];
                        count += 1.0f;
                    }
            result[chart.at(x, y)] = sum / std::max(count, 1.0f);
        }
    return result;
}

/// True if a point of a facet's plane lies in the facet.
bool contains(const Facet& facet, const glm::vec3& normal, const glm::vec3& point)
{
    bool is_in = true;
    for (int k = 0; k < facet.count; ++k) {
        const glm::vec3 &from = facet.corner[k], &to = facet.corner[(k + 1) % facet.count];
        is_in = is_in && glm::dot(glm::cross(to - from, point - from), normal) >= 0.0f;
    }
    return is_in;
}

/// True if all estimates agree at all lumels of the chart: nothing is to be filtered.
template <std::size_t Count>
bool is_known(const FilterChart& chart, const std::array<const Estimates*, Count>& found)
{
    return std::ranges::all_of(chart.lumel, [&](std::uint32_t i) {
        return i == kNoLumel || std::ranges::all_of(found, [&](const Estimates* one) {
                   return (*one)[i] == (*found[0])[i];
               });
    });
}

/// [texels] > 0 near lumels whose halves differ.
std::vector<float> uncertain_in(const FilterChart& chart, const Estimates& one,
                                const Estimates& other)
{
    std::vector<float> differs(chart.lumel.size(), 0.0f);
    for (std::size_t t = 0; t < differs.size(); ++t)
        if (const std::uint32_t i = chart.lumel[t]; i != kNoLumel)
            differs[t] = one[i] != other[i] ? 1.0f : 0.0f;
    return smoothed(chart, differs, kUncertainReach);
}

}  // namespace

ChartFilter::ChartFilter(const LinkWork& work, const SubLumels& parts,
                         const RayDistances& distances)
    : work_(work),
      parts_(parts),
      by_side_(lumels_by_side(work.scene.lumels)),
      places_(chart_places(work.scene.lumels)),
      steps_(work.world.size()),
      nearness_(work.world.size())
{
    const auto end_of = [&](std::size_t block) {
        return std::min((block + 1) * kLumelsPerTask, steps_.size());
    };
    const std::size_t blocks = (steps_.size() + kLumelsPerTask - 1) / kLumelsPerTask;
    parallel_for_own(work.ranks, 0, blocks, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first * kLumelsPerTask; i < end_of(last - 1); ++i)
            steps_[i] = find_steps(i, distances.nearest);
    });
    share_bytes(work.ranks, 0, blocks, [&](std::size_t b) {
        const std::size_t first = b * kLumelsPerTask;
        return std::as_writable_bytes(std::span(steps_).subspan(first, end_of(b) - first));
    });
    for (std::size_t i = 0; i < nearness_.size(); ++i)
        nearness_[i] = work.world[i].size * distances.inverse[i];
}

std::uint64_t ChartFilter::bytes(std::size_t lumels, std::size_t texels)
{
    return 2 * texels * sizeof(std::uint32_t) + lumels * (sizeof(std::uint8_t) + sizeof(float));
}

/// As if all charts were filtered at once: light of the level, finer, fitted and filtered, and what
/// else cells have.
std::uint64_t ChartFilter::working_bytes(std::size_t lumels)
{
    constexpr std::size_t kLevels = 4;  // of gains
    return lumels * (4 * sizeof(FitLight<kSolutions>) + (18 + kLevels) * sizeof(float));
}

/// Bits of the neighbours on the same chart and side across which the filter may step.
std::uint8_t ChartFilter::find_steps(std::size_t i, const std::vector<float>& nearest) const
{
    const Lumel& lumel = work_.lumels()[i];
    if ((lumel.flags & kLumelBuried) || parts_.is_cut(i))
        return 0;
    const int width = work_.scene.lumels.width, x = int(lumel.texel) % width,
              y = int(lumel.texel) / width, side = is_back(lumel) ? 1 : 0;
    unsigned steps = 0;
    for (unsigned s = 0; s < kSteps.size(); ++s) {
        const std::uint32_t j =
            lit_lumel_at(work_.scene.lumels, by_side_, x + kSteps[s].x, y + kSteps[s].y, side);
        if (j != kNoLumel && work_.lumels()[j].chart == lumel.chart && !parts_.is_cut(j) &&
            may_step(i, j, std::min(nearest[i], nearest[j])))
            steps |= 1u << s;
    }
    return std::uint8_t(steps);
}

/// True if no geometry separates two neighbours. nearest: distance to the nearest geometry [m].
bool ChartFilter::may_step(std::size_t i, std::size_t j, float nearest) const
{
    const WorldLumel &a = work_.world[i], &b = work_.world[j];
    if (nearest > kMayStandBetween * glm::distance(a.centre, b.centre))
        return true;
    const float ray_offset =
        std::max(kLift * std::max(a.size, b.size), work_.scene.rays.ray_offset());
    return work_.scene.rays.sees(open_middle(i) + ray_offset * a.normal,
                                 open_middle(j) + ray_offset * b.normal, 0.0f, std::uint32_t(i));
}

/// The centre of a lumel or, if other geometry covers that, the nearest open cell.
glm::vec3 ChartFilter::open_middle(std::size_t i) const
{
    const WorldLumel& lumel = work_.world[i];
    const bool is_open =
        std::any_of(work_.world.begin(lumel), work_.world.end(lumel), [&](const Facet& facet) {
            return contains(facet, lumel.normal, lumel.centre);
        });
    if (is_open)
        return lumel.centre;
    const CellPoints points = cell_points(work_.world, work_.cells, i);
    return points.point[points.nearest(lumel.centre)].position;
}

/// Calls visit(lumel, x, y) for the lumels of a chart that take part in the filter.
template <class Visit>
void ChartFilter::visit_lumels(const ChartPlace& place, const Visit& visit) const
{
    for (int y = place.low.y; y <= place.high.y; ++y)
        for (int x = place.low.x; x <= place.high.x; ++x) {
            const std::uint32_t i =
                lit_lumel_at(work_.scene.lumels, by_side_, x, y, place.is_back ? 1 : 0);
            if (i != kNoLumel && work_.lumels()[i].chart == place.chart && !parts_.is_cut(i))
                visit(i, x - place.low.x, y - place.low.y);
        }
}

FilterChart ChartFilter::chart_at(const ChartPlace& place) const
{
    const glm::ivec2 size = place.high - place.low + 1;
    const std::size_t texels = std::size_t(size.x) * std::size_t(size.y);
    FilterChart chart{.width = size.x, .height = size.y};
    chart.lumel.assign(texels, kNoLumel);
    chart.steps.assign(texels, 0);
    chart.normal.assign(texels, glm::vec3(0.0f));
    chart.nearness.assign(texels, 0.0f);
    visit_lumels(place, [&](std::uint32_t i, int x, int y) {
        const std::size_t t = chart.at(x, y);
        chart.lumel[t] = i;
        chart.steps[t] = steps_[i];
        chart.normal[t] = work_.world[i].normal;
        chart.nearness[t] = nearness_[i];
    });
    return chart;
}

/// Gives each rank what the others have found on their charts.
void ChartFilter::share(Mean& mean) const
{
    struct OfLumel {
        glm::vec3 light;
        float noise, wrong;
        glm::vec2 apart;
        glm::vec3 bend;
    };
    const auto write = [&](StateWriter& writer, std::size_t n) {
        std::vector<OfLumel> all;
        visit_lumels(places_[n], [&](std::uint32_t i, int, int) {
            all.push_back(
                {mean.light[i], mean.noise[i], mean.wrong[i], mean.apart[i], mean.bend[i]});
        });
        writer(all);
    };
    const auto read = [&](StateReader& reader, std::size_t n) {
        std::vector<OfLumel> all;
        reader(all);
        auto next = all.begin();
        visit_lumels(places_[n], [&](std::uint32_t i, int, int) {
            mean.light[i] = next->light;
            mean.noise[i] = next->noise;
            mean.wrong[i] = next->wrong;
            mean.apart[i] = next->apart;
            mean.bend[i] = next->bend;
            ++next;
        });
    };
    share_blocks(work_.ranks, 0, places_.size(), {.write = write, .read = read});
}

/// Calls visit(chart, filtered estimates) for each chart of this rank, in parallel.
template <std::size_t Count, class Visit>
void ChartFilter::filter(const std::array<const Estimates*, Count>& found, const PyramidRule& rule,
                         const Visit& visit) const
{
    parallel_for_own(work_.ranks, 0, places_.size(), 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) {
            FilterChart chart = chart_at(places_[n]);
            if (is_known(chart, found))
                continue;
            if (rule.is_bounded)
                chart.nearness = smoothed(chart, chart.nearness, kNearnessReach);
            visit(chart, filter_chart<Count>(chart, found, rule));
        }
    });
}

Mean ChartFilter::indirect(const Solutions& found) const
{
    Mean mean = plain_mean(found);
    filter<kSolutions>(
        {&found[0], &found[1], &found[2]}, rule_of_indirect(),
        [&](const FilterChart& chart, const Filtered<kSolutions>& filtered) {
            for (std::size_t t = 0; t < filtered.light.size(); ++t) {
                const std::uint32_t i = chart.lumel[t];
                if (i == kNoLumel)
                    continue;
                std::array<glm::vec3, kSolutions> light, bend;
                for (std::size_t k = 0; k < kSolutions; ++k) {
                    light[k] = estimate_of<kSolutions>(filtered.light[t], k);
                    bend[k] = light[k] - found[k][i];
                }
                mean.light[i] = glm::max((light[0] + light[1] + light[2]) / 3.0f, glm::vec3(0.0f));
                mean.noise[i] = float(spread(light[0], light[1], light[2]) / 18.0);
                mean.apart[i] = apart(light[0], light[1], light[2]);
                mean.bend[i] = {luminance(bend[0]), luminance(bend[1]), luminance(bend[2])};
                mean.wrong[i] = (glm::dot(bend[0], bend[1]) + glm::dot(bend[1], bend[2]) +
                                 glm::dot(bend[2], bend[0])) /
                                3.0f;
            }
        });
    share(mean);
    return mean;
}

/// [N] Kind of each lumel.
std::vector<std::uint32_t> ChartFilter::find_kinds() const
{
    const auto& lumels = work_.lumels();
    std::vector<std::uint32_t> of_chart;
    for (const Lumel& lumel : lumels) {
        of_chart.resize(std::max<std::size_t>(of_chart.size(), lumel.chart + 1), 0);
        ++of_chart[lumel.chart];
    }
    const auto part = [](double octaves, int classes) {
        return std::uint32_t(std::clamp(octaves, 0.0, double(classes - 1)));
    };
    std::vector<std::uint32_t> kinds(lumels.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const double away = 1.0 / std::max(double(nearness_[i]), 1e-9);  // [lumels]
        kinds[i] = part(std::log2(away), kNearnessClasses) * kSizeClasses +
                   part(0.5 * std::log2(double(of_chart[lumels[i].chart])), kSizeClasses);
    }
    return kinds;
}

std::vector<double> ChartFilter::variance_left(const std::vector<double>& raw,
                                               const std::vector<double>& filtered) const
{
    const std::vector<std::uint32_t> kinds = find_kinds();
    std::array<double, kNearnessClasses * kSizeClasses> before{}, left{};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        before[kinds[i]] += raw[i];
        left[kinds[i]] += filtered[i];
    }
    std::vector<double> result(kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i)
        result[i] = before[kinds[i]] > 0.0 ? left[kinds[i]] / before[kinds[i]] : 1.0;
    return result;
}

Mean ChartFilter::direct(const Estimates& one, const Estimates& other) const
{
    Mean mean = plain_mean(one, other);
    filter<2>({&one, &other}, rule_of_direct(),
              [&](const FilterChart& chart, const Filtered<2>& filtered) {
                  const std::vector<float> uncertain = uncertain_in(chart, one, other);
                  for (std::size_t t = 0; t < uncertain.size(); ++t) {
                      const std::uint32_t i = chart.lumel[t];
                      if (i == kNoLumel || uncertain[t] == 0.0f)
                          continue;
                      const glm::vec3 a = estimate_of<2>(filtered.light[t], 0),
                                      b = estimate_of<2>(filtered.light[t], 1);
                      mean.light[i] = glm::max(0.5f * (a + b), glm::vec3(0.0f));
                      mean.noise[i] = 0.25f * glm::dot(a - b, a - b);
                      mean.wrong[i] = glm::dot(a - one[i], b - other[i]);
                      mean.apart[i] = apart(a, b);
                      // The one product of two counts as three.
                      mean.bend[i] =
                          std::numbers::sqrt3_v<float> *
                          glm::vec3(luminance(a - one[i]), luminance(b - other[i]), 0.0f);
                  }
              });
    share(mean);
    return mean;
}

namespace {

/// Filters parts of a chart's light, where is_filtered(texel).
template <class IsFiltered>
void filter_parts(const FilterChart& chart, const Outliers& outliers, const PyramidGains& gains,
                  std::span<Estimates> parts, const IsFiltered& is_filtered)
{
    for (std::size_t first = 0; first < parts.size(); first += kFilteredTogether) {
        const std::size_t count = std::min(kFilteredTogether, parts.size() - first);
        std::array<const Estimates*, kFilteredTogether> found;
        for (std::size_t k = 0; k < found.size(); ++k)
            found[k] = &parts[first + std::min(k, count - 1)];
        const std::vector<FitLight<kFilteredTogether>> filtered =
            filter_chart_by(outliers, gains, chart, found);
        for (std::size_t t = 0; t < filtered.size(); ++t)
            if (const std::uint32_t i = chart.lumel[t]; i != kNoLumel && is_filtered(t))
                for (std::size_t k = 0; k < count; ++k)
                    parts[first + k][i] = estimate_of<kFilteredTogether>(filtered[t], k);
    }
}

}  // namespace

void ChartFilter::indirect_parts(const Solutions& found, std::span<Estimates> parts) const
{
    filter<kSolutions>({&found[0], &found[1], &found[2]}, rule_of_indirect(),
                       [&](const FilterChart& chart, const Filtered<kSolutions>& filtered) {
                           filter_parts(chart, filtered.outliers, filtered.gains, parts,
                                        [](std::size_t) { return true; });
                       });
}

void ChartFilter::direct_parts(const Estimates& one, const Estimates& other,
                               std::span<Estimates> parts) const
{
    filter<2>({&one, &other}, rule_of_direct(),
              [&](const FilterChart& chart, const Filtered<2>& filtered) {
                  const std::vector<float> uncertain = uncertain_in(chart, one, other);
                  filter_parts(chart, filtered.outliers, filtered.gains, parts,
                               [&](std::size_t t) { return uncertain[t] != 0.0f; });
              });
}

}  // namespace lumel
