// LinkRadiosity's rays: how many each lumel sends in a round.

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtx/norm.hpp>

#include "base/core/luminance.h"
#include "links/direct/deviation.h"
#include "links/kept/link_rows.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Fraction of rays allocated uniformly.
constexpr double kEvenShare = 0.25;
/// First rays of a cut lumel, if memory allows: each sub-lumel has a share of them only.
constexpr std::uint16_t kFirstOfCut = 32;
/// Rays of the second round, relative to those of the first, from which on they gain more by a
/// guide than it takes to learn it.
constexpr double kWorthAGuide = 0.25;
/// Maximum assumed gain of guided rays: few rays tell it, and a further round costs more than rays.
constexpr double kMostGain = 1.5;
/// Rays that a limit leaves after a round, relative to all so far, that are not worth another.
constexpr double kTooFew = 0.05;
/// Relative noise above which a lumel gets more rays than the errors over all lumels ask for; the
/// most that those add, relative to all rays so far; and to the lumel's.
constexpr double kNoisyLumel = 0.04, kShareOfNoisy = 0.15, kMostOfNoisy = 8.0;
/// Distance of neighbours whose light in two solutions tells the deviation.
constexpr NearReach kReachOfOthers{2, 5};
/// Charts whose visible noise is between these multiples of its target get rays with noisier ones.
constexpr double kLeastBeside = 0.9, kMostBeside = 1.25;
/// Bisection steps for the rays that all lumels add.
constexpr int kFillSteps = 24;
/// Minimum brightness in ray allocation, relative to the mean.
constexpr double kDarkest = 1e-2;

/// The scale at which sum(scale) reaches `wanted`. sum: increasing, without bound. start: above 0.
template <class Sum>
double scale_for(double wanted, double start, const Sum& sum)
{
    double low = 0.0, high = start;
    while (sum(high) < wanted)
        high *= 2.0;
    for (int step = 0; step < kFillSteps; ++step) {
        const double middle = 0.5 * (low + high);
        (sum(middle) < wanted ? low : high) = middle;
    }
    return high;
}

/// Number of charts whose visible noise is at most `most`. charts: in_order().
std::size_t charts_up_to(double most, std::span<const ChartNoise> charts)
{
    const auto is_below = [&](const ChartNoise& chart) {
        return chart.power_in(chart.worst_band()) <= most * most;
    };
    return std::size_t(std::ranges::partition_point(charts, is_below) - charts.begin());
}

}  // namespace

/// Allocates the rays of the next round. Vectors have a component for each solution.
struct LinkRadiosity::RayNeeds {
    std::vector<glm::dvec3> sent;       ///< [N] rays so far that count
    std::vector<glm::dvec3> deviation;  ///< [N] deviation_of_ray() by weights()
    std::vector<glm::dvec3> of_charts;  ///< [N] by chart_weights(); empty: no chart is noisy
};

/// [N] Variance of the rays of each lumel so far / of those of the next round, in a solution.
std::vector<double> LinkRadiosity::gain_of_guide(std::size_t k,
                                                 const std::vector<glm::dvec3>& sent) const
{
    std::vector<double> gain(sent.size(), 1.0);
    if (guide_.empty())
        return gain;
    const auto visit = [&](std::size_t b) {
        const std::vector<std::uint16_t>& first = links_[k]->rounds.front()[b].rays;
        for (std::size_t n = 0; n < first.size(); ++n) {
            const std::uint32_t i = lumels_of(work_, b)[n];
            const double even = std::min(double(first[n]) / std::max(sent[i][int(k)], 1.0), 1.0);
            const double of_guided = std::min(double(guide_.of(i, k).gain), kMostGain);
            gain[i] = of_guided / (even + (1.0 - even) * of_guided);
        }
    };
    parallel_for_own(work_.ranks, 0, tracer_->blocks(), kRowBlocksPerTask,
                     [&](std::size_t from, std::size_t to) {
                         for (std::size_t b = from; b < to; ++b)
                             visit(b);
                     });
    share_rows(work_, [&](auto& archive, std::uint32_t i) { archive(gain[i]); });
    return gain;
}

/// [N] Weight of each lumel's squared error. With a target for the eye that of its measure; for
/// dark lumels 1 / irradiance, halfway between absolute and relative errors.
std::vector<double> LinkRadiosity::weights() const
{
    std::vector<double> weight(work_.order.size(), 1.0);
    if (target_eye_error_ > 0.0 && !adapted_.empty()) {
        for (std::size_t i = 0; i < weight.size(); ++i)
            weight[i] = adapted_[i] > 0.0 ? std::pow(mean_light_ / adapted_[i], 2.0) : 0.0;
    } else if (target_dark_error_ > 0.0)
        for (std::size_t i = 0; i < weight.size(); ++i) {
            const glm::vec3 all = arrived(i);
            weight[i] = 1.0 / (double(all.r + all.g + all.b) + kDarkest * mean_light_);
        }
    return weight;
}

/// The charts whose visible noise is above its target, among those that count.
std::span<const ChartNoise> LinkRadiosity::noisy_charts() const
{
    if (!(target_visible_noise_ > 0.0) || noise_.empty())
        return {};
    const auto counts = std::span(noise_).first(worst_that_counts(noise_) + 1);
    return counts.subspan(charts_up_to(target_visible_noise_, counts));
}

/// noisy_charts(), and those beside the target, if there are any: else the next round would find
/// one of them just above it, or as the worst that counts.
std::span<const ChartNoise> LinkRadiosity::charts_to_clean() const
{
    const std::span<const ChartNoise> noisy = noisy_charts();
    if (noisy.empty())
        return {};
    const std::size_t first = charts_up_to(kLeastBeside * target_visible_noise_, noise_),
                      last = std::max(worst_that_counts(noise_) + 1,
                                      charts_up_to(kMostBeside * target_visible_noise_, noise_));
    return std::span(noise_).subspan(first, last - first);
}

/// [N] Weight of each lumel's squared error for the noise of charts_to_clean(). Variances of charts
/// end equal if their weights are in proportion to what they are now.
std::vector<double> LinkRadiosity::chart_weights() const
{
    std::vector<double> weight(work_.order.size(), 0.0);
    for (const ChartNoise& chart : charts_to_clean()) {
        const double power = chart.power_in(chart.worst_band());
        for (const std::uint32_t i : chart.lumels) {
            const double light =
                std::max(double(luminance(arrived(i))), double(kFaintestAround) * chart.light);
            weight[i] = power / (light * light);
        }
        for (const std::uint32_t i : chart.beside) {
            const double light = std::max(double(luminance(arrived(i))), chart.light);
            weight[i] = power / (light * light);
        }
    }
    return weight;
}

/// [N] Rays of each lumel so far that count.
std::vector<glm::dvec3> LinkRadiosity::rays_so_far() const
{
    std::vector<glm::dvec3> rays(work_.order.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i < rays.size(); ++i)
        for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p)
            rays[i] += glm::dvec3(sources_[0].rays[p], sources_[1].rays[p], sources_[2].rays[p]);
    return rays;
}

/// [N] Weighted deviation of one ray of each lumel that the filter leaves, in a solution estimated
/// from the others: rays allocated by a solution's own light would change the result. They do so
/// even by that of neighbours, whose rays are stratified with the lumel's: where theirs have met a
/// lamp, its own have not. Only weights and what the filter leaves are of all light, filtered.
/// sent: rays_so_far().
std::vector<glm::dvec3> LinkRadiosity::deviation_of_ray(const std::vector<glm::dvec3>& sent,
                                                        const std::vector<double>& weight)
{
    std::vector<glm::dvec3> raw(work_.order.size());
    std::vector<double> before(raw.size()), after(raw.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const glm::vec3 a = indirect(i, 0), b = indirect(i, 1), c = indirect(i, 2);
        const glm::dvec3 apart(glm::distance2(b, c), glm::distance2(c, a), glm::distance2(a, b));
        before[i] = weight[i] * (apart.x + apart.y + apart.z) / 18.0;  // as in plain_mean()
        after[i] = weight[i] * double(mean_.noise[i]);
        // Two solutions differ by the variance of a ray × (1 / rays of one + 1 / rays of the
        // other).
        const glm::dvec3 one = 1.0 / glm::max(sent[i], glm::dvec3(1.0));
        const glm::dvec3 of_others(one.y + one.z, one.z + one.x, one.x + one.y);
        raw[i] = weight[i] * apart / (double(kSolutions) * of_others);
    }
    std::vector<glm::dvec3> deviation =
        deviation_nearby(raw, work_.scene.lumels, work_.order, kReachOfOthers, 1.0);
    if (const ChartFilter* const by = filter()) {
        const std::vector<double> left = by->variance_left(before, after);
        for (std::size_t i = 0; i < deviation.size(); ++i)
            deviation[i] *= std::sqrt(left[i]);
    }
    return deviation;
}

LinkRadiosity::RayNeeds LinkRadiosity::find_needs()
{
    RayNeeds needs{.sent = rays_so_far()};
    needs.deviation = deviation_of_ray(needs.sent, weights());
    if (!noisy_charts().empty())
        needs.of_charts = deviation_of_ray(needs.sent, chart_weights());
    return needs;
}

/// Rays of the first round: as many for all, but more for cut lumels. most: per lumel.
void LinkRadiosity::send_first_rays(double most)
{
    mean_rays_ = options_.even_rays > 0 ? double(options_.even_rays) / double(kSolutions)
                                        : double(kFirstRays);
    mean_rays_ = std::min(mean_rays_, most);
    std::vector<std::uint16_t> rays(work_.order.size(), std::uint16_t(std::lround(mean_rays_)));
    if (options_.even_rays == 0 && rays_that_fit() >= double(kFirstOfCut))
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (parts_->is_cut(i))
                rays[i] = std::max(rays[i], kFirstOfCut);
    rays_.fill(rays);
}

/// [N] Rays that lumels add in a solution for errors over all of them, `mean` on average. The sum
/// of variances is minimal if all rays of a lumel are proportional to the deviation of one; lumels
/// are filled up to that. Some rays are uniform, since lumels whose rays have not found a light yet
/// seem noiseless.
std::vector<double> LinkRadiosity::rays_by_deviation(int k, double mean, const RayNeeds& needs,
                                                     const std::vector<double>& gain) const
{
    std::vector<double> rays(needs.sent.size(), 0.0);
    if (!(mean > 0.0))
        return rays;
    struct OfLumel {
        double deviation, sent;

        double added(double scale) const { return std::max(scale * deviation - sent, 0.0); }
    };
    const auto of = [&](std::size_t i) { return OfLumel{needs.deviation[i][k], needs.sent[i][k]}; };
    std::vector<OfLumel> lit;  // read some forty times
    double widest = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i)
        if (!work_.is_buried(i)) {
            lit.push_back(of(i));
            widest = std::max(widest, lit.back().deviation);
        }
    if (!(widest > 0.0))
        return std::vector<double>(rays.size(), mean);
    const double scale =
        scale_for((1.0 - kEvenShare) * mean * double(lit.size()), 1.0 / widest, [&](double tried) {
            double sum = 0.0;
            for (const OfLumel& one : lit)
                sum += one.added(tried);
            return sum;
        });
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] = kEvenShare * mean + (work_.is_buried(i) ? 0.0 : of(i).added(scale) / gain[i]);
    return rays;
}

/// Raises the rays that the noisiest lumels add. They are few, as in the corners of a room, but an
/// eye sees each.
void LinkRadiosity::add_rays_of_noisy(int k, const RayNeeds& needs, const std::vector<double>& gain,
                                      std::vector<double>& rays) const
{
    if (!(target_eye_error_ > 0.0) || adapted_.empty() || !(mean_light_ > 0.0))
        return;
    // √(Σ d² / 3) / (Σ adapted / 3), as in estimate_for_eye(); weights() are of mean_light_.
    const double quiet = kNoisyLumel * mean_light_ / std::sqrt(3.0);
    const auto wanted = [&](std::size_t i) {
        const double ratio = needs.deviation[i][k] / quiet, sent = needs.sent[i][k];
        return std::clamp(ratio * ratio - sent, 0.0, kMostOfNoisy * sent);
    };
    double all = 0.0, most = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        all += needs.sent[i][k];
        most += wanted(i);
    }
    const double share = std::min(1.0, kShareOfNoisy * all / std::max(most, 1.0));
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] = std::max(rays[i], share * wanted(i) / gain[i]);
}

/// Raises the rays that lumels add on charts whose visible noise is above its target; within a
/// chart all rays are in proportion to the deviation of one.
void LinkRadiosity::add_rays_of_charts(int k, const RayNeeds& needs,
                                       const std::vector<double>& gain,
                                       std::vector<double>& rays) const
{
    for (const ChartNoise& chart : charts_to_clean()) {
        const double ratio = rays_for(chart);
        if (ratio <= 1.0)
            continue;
        double sum = 0.0, of_deviations = 0.0;
        for (const std::uint32_t i : chart.lumels) {
            sum += needs.sent[i][k];
            of_deviations += needs.of_charts[i][k];
        }
        if (!(of_deviations > 0.0))
            continue;
        const double scale = ratio * sum / of_deviations;
        for (const auto* lumels : {&chart.lumels, &chart.beside})
            for (const std::uint32_t i : *lumels)
                rays[i] =
                    std::max(rays[i], (scale * needs.of_charts[i][k] - needs.sent[i][k]) / gain[i]);
    }
}

/// Allocates the rays of a later round, at most `most` per lumel and solution; before the second,
/// learns to guide them.
void LinkRadiosity::share_out_rays(double most)
{
    const RayNeeds needs = find_needs();
    allocate(needs, most);
    const double so_far = double(state_.shots) / double(kSolutions);
    if (round_ == 1 && mean_rays_ > kWorthAGuide * so_far && learn_guide())
        allocate(needs, most);
}

void LinkRadiosity::allocate(const RayNeeds& needs, double most)
{
    std::array<std::vector<double>, kSolutions> rays;
    double sum = 0.0, lit = 0.0;
    for (std::size_t k = 0; k < kSolutions; ++k) {
        const std::vector<double> gain = gain_of_guide(k, needs.sent);
        rays[k] = rays_by_deviation(int(k), std::min(more_rays(), most), needs, gain);
        add_rays_of_charts(int(k), needs, gain, rays[k]);
        if (round_ == 1 && std::ranges::any_of(rays[k], [](double more) { return more > 0.0; }))
            add_rays_of_noisy(int(k), needs, gain, rays[k]);
        for (std::size_t i = 0; i < rays[k].size(); ++i) {
            sum += rays[k][i];
            lit += work_.is_buried(i) ? 0.0 : 1.0;
        }
    }
    mean_rays_ = sum / std::max(lit, 1.0);
    // Rays that the limit would leave for a round too small are sent in this one.
    const double after = double(state_.shots) / double(kSolutions) + mean_rays_;
    const bool is_last = more_rays() >= most && most - mean_rays_ < kTooFew * after;
    const double scale =
        mean_rays_ > most || (is_last && mean_rays_ > 0.0) ? most / mean_rays_ : 1.0;
    mean_rays_ *= scale;
    for (std::size_t k = 0; k < kSolutions; ++k)
        std::ranges::transform(rays[k], rays_[k].begin(), [&](double one) {
            return std::uint16_t(std::clamp(std::lround(scale * one), 0l, long(kMaxLinks)));
        });
}

}  // namespace lumel
