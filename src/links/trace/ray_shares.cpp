// LinkRadiosity's rays: how many each lumel sends in a round.

#include <algorithm>
#include <cmath>

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
/// Maximum assumed gain of guided rays: few rays tell it, and a further round costs more than rays.
constexpr double kMostGain = 3.0;
/// Rays that a limit leaves after a round, relative to all so far, that are not worth another.
constexpr double kTooFew = 0.05;
/// Relative noise above which a lumel gets more rays than the errors over all lumels ask for; the
/// most that those add, relative to all rays so far; and to the lumel's.
constexpr double kNoisyLumel = 0.04, kShareOfNoisy = 0.15, kMostOfNoisy = 8.0;
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

/// Rays to add to `sent` for the variance of `wanted` rays like them, if the new ones have 1 / gain
/// of their variance: x sent, with (1 + x / gain) / (1 + x)² = sent / wanted.
double guided_rays(double sent, double wanted, double gain)
{
    if (!(wanted > sent))
        return 0.0;
    if (!(sent > 0.0))
        return wanted;
    const double ratio = wanted / sent, half = 1.0 - 0.5 * ratio / gain;
    return sent * (std::sqrt(half * half + ratio - 1.0) - half);
}

}  // namespace

/// [N] Variance of the rays of each lumel so far / of those of the next round. sent: rays_so_far().
std::vector<double> LinkRadiosity::gain_of_guide(const std::vector<double>& sent) const
{
    std::vector<double> gain(sent.size(), 1.0);
    if (guide_.empty())
        return gain;
    const auto visit = [&](std::size_t b) {
        const std::vector<std::uint16_t>& first = links_[0]->rounds.front()[b].rays;
        for (std::size_t n = 0; n < first.size(); ++n) {
            const std::uint32_t i = lumels_of(work_, b)[n];
            const double even = std::min(double(first[n]) / std::max(sent[i], 1.0), 1.0);
            gain[i] = even * std::min(double(guide_.tables[guide_.group[i]].gain), kMostGain) +
                      1.0 - even;
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
    const auto is_clean = [&](const ChartNoise& chart) {
        return chart.power_in(chart.worst_band()) <= target_visible_noise_ * target_visible_noise_;
    };
    const auto counts = std::span(noise_).first(worst_that_counts(noise_) + 1);
    return counts.subspan(
        std::size_t(std::ranges::partition_point(counts, is_clean) - counts.begin()));
}

/// [N] Weight of each lumel's squared error for the noise of noisy_charts(). Variances of charts
/// end equal if their weights are in proportion to what they are now.
std::vector<double> LinkRadiosity::chart_weights() const
{
    std::vector<double> weight(work_.order.size(), 0.0);
    for (const ChartNoise& chart : noisy_charts()) {
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

/// [N] Rays of each lumel so far that count, per solution.
std::vector<double> LinkRadiosity::rays_so_far() const
{
    std::vector<double> rays(work_.order.size(), 0.0);
    for (std::size_t i = 0; i < rays.size(); ++i)
        for (const SourceTerm& source : sources_)
            for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p)
                rays[i] += double(source.rays[p]) / double(kSolutions);
    return rays;
}

/// [N] Weighted deviation of one ray of each lumel that the filter leaves, estimated from other
/// lumels: rays allocated by a lumel's own error, or by light that the filter spread from it, would
/// darken the result. sent: rays_so_far().
std::vector<double> LinkRadiosity::deviation_of_ray(const std::vector<double>& sent,
                                                    const std::vector<double>& weight)
{
    std::vector<double> raw(work_.order.size()), filtered(work_.order.size());
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const double scale = weight[i] * sent[i];
        // As in plain_mean().
        raw[i] = scale * spread(indirect(i, 0), indirect(i, 1), indirect(i, 2)) / 18.0;
        filtered[i] = scale * double(mean_.noise[i]);
    }
    std::vector<double> deviation =
        deviation_nearby(raw, work_.scene.lumels, work_.order, kIndirectReach, 0.0);
    if (const ChartFilter* const by = filter()) {
        const std::vector<double> left = by->variance_left(raw, filtered);
        for (std::size_t i = 0; i < deviation.size(); ++i)
            deviation[i] *= std::sqrt(left[i]);
    }
    return deviation;
}

/// Rays of the first round: as many for all, but more for cut lumels. most: per lumel.
void LinkRadiosity::send_first_rays(double most)
{
    mean_rays_ = options_.even_rays > 0 ? double(options_.even_rays) / double(kSolutions)
                                        : double(kFirstRays);
    mean_rays_ = std::min(mean_rays_, most);
    rays_.assign(work_.order.size(), std::uint16_t(std::lround(mean_rays_)));
    if (options_.even_rays > 0 || rays_that_fit() < double(kFirstOfCut))
        return;
    for (std::size_t i = 0; i < rays_.size(); ++i)
        if (parts_->is_cut(i))
            rays_[i] = std::max(rays_[i], kFirstOfCut);
}

/// [N] Rays that lumels add to `sent` for errors over all of them, `mean` on average. The sum of
/// variances is minimal if all rays of a lumel are proportional to the deviation of one; lumels are
/// filled up to that. Some rays are uniform, since lumels whose rays have not found a light yet
/// seem noiseless.
std::vector<double> LinkRadiosity::rays_by_deviation(double mean, const std::vector<double>& sent,
                                                     const std::vector<double>& deviation,
                                                     const std::vector<double>& gain) const
{
    std::vector<double> rays(sent.size(), 0.0);
    if (!(mean > 0.0))
        return rays;
    struct OfLumel {
        double deviation, sent;

        double added(double scale) const { return std::max(scale * deviation - sent, 0.0); }
    };
    std::vector<OfLumel> lit;  // read some forty times
    double widest = 0.0;
    for (std::size_t i = 0; i < deviation.size(); ++i)
        if (!work_.is_buried(i)) {
            lit.push_back({deviation[i], sent[i]});
            widest = std::max(widest, deviation[i]);
        }
    if (!(widest > 0.0))
        return std::vector<double>(sent.size(), mean);
    const double scale =
        scale_for((1.0 - kEvenShare) * mean * double(lit.size()), 1.0 / widest, [&](double tried) {
            double sum = 0.0;
            for (const OfLumel& one : lit)
                sum += one.added(tried);
            return sum;
        });
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const double added = work_.is_buried(i) ? 0.0 : OfLumel{deviation[i], sent[i]}.added(scale);
        rays[i] = kEvenShare * mean + guided_rays(sent[i], sent[i] + added, gain[i]);
    }
    return rays;
}

/// Raises the rays that the noisiest lumels add to `sent`. They are few, as in the corners of a
/// room, but an eye sees each.
void LinkRadiosity::add_rays_of_noisy(const std::vector<double>& sent,
                                      const std::vector<double>& deviation,
                                      const std::vector<double>& gain,
                                      std::vector<double>& rays) const
{
    if (!(target_eye_error_ > 0.0) || adapted_.empty() || !(mean_light_ > 0.0))
        return;
    // √(Σ d² / 3) / (Σ adapted / 3), as in estimate_for_eye(); weights() are of mean_light_.
    const double quiet = kNoisyLumel * mean_light_ / std::sqrt(3.0);
    const auto wanted = [&](std::size_t i, double share) {
        const double ratio = deviation[i] / quiet;
        return sent[i] + share * std::clamp(ratio * ratio - sent[i], 0.0, kMostOfNoisy * sent[i]);
    };
    double all = 0.0, most = 0.0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
        all += sent[i];
        most += wanted(i, 1.0) - sent[i];
    }
    const double share = std::min(1.0, kShareOfNoisy * all / std::max(most, 1.0));
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays[i] = std::max(rays[i], guided_rays(sent[i], wanted(i, share), gain[i]));
}

/// Raises the rays that lumels add to `sent` on charts whose visible noise is above its target;
/// within a chart all rays are in proportion to the deviation of one.
void LinkRadiosity::add_rays_of_charts(const std::vector<double>& sent,
                                       const std::vector<double>& gain, std::vector<double>& rays)
{
    const std::span<const ChartNoise> noisy = noisy_charts();
    if (noisy.empty())
        return;
    const std::vector<double> deviation = deviation_of_ray(sent, chart_weights());
    for (const ChartNoise& chart : noisy) {
        const double ratio = rays_for(chart);
        if (ratio <= 1.0)
            continue;
        double sum = 0.0, of_deviations = 0.0;
        for (const std::uint32_t i : chart.lumels) {
            sum += sent[i];
            of_deviations += deviation[i];
        }
        if (!(of_deviations > 0.0))
            continue;
        for (const auto* lumels : {&chart.lumels, &chart.beside})
            for (const std::uint32_t i : *lumels)
                rays[i] = std::max(
                    rays[i],
                    guided_rays(sent[i], ratio * sum / of_deviations * deviation[i], gain[i]));
    }
}

/// Allocates the rays of a later round, at most `most` per lumel.
void LinkRadiosity::share_out_rays(double most)
{
    const std::vector<double> sent = rays_so_far();
    std::vector<double> rays(sent.size(), 0.0);
    const double mean = std::min(more_rays(), most);
    if (mean > 0.0 || !noisy_charts().empty()) {
        const std::vector<double> gain = gain_of_guide(sent);
        const std::vector<double> deviation = deviation_of_ray(sent, weights());
        rays = rays_by_deviation(mean, sent, deviation, gain);
        add_rays_of_charts(sent, gain, rays);
        if (round_ == 1 && std::ranges::any_of(rays, [](double more) { return more > 0.0; }))
            add_rays_of_noisy(sent, deviation, gain, rays);
    }
    double sum = 0.0, lit = 0.0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        sum += rays[i];
        lit += work_.is_buried(i) ? 0.0 : 1.0;
    }
    mean_rays_ = sum / std::max(lit, 1.0);
    // Rays that the limit would leave for a round too small are sent in this one.
    const double after = double(state_.shots) / double(kSolutions) + mean_rays_;
    const bool is_last = more_rays() >= most && most - mean_rays_ < kTooFew * after;
    const double scale =
        mean_rays_ > most || (is_last && mean_rays_ > 0.0) ? most / mean_rays_ : 1.0;
    mean_rays_ *= scale;
    for (std::size_t i = 0; i < rays.size(); ++i)
        rays_[i] = std::uint16_t(std::clamp(std::lround(scale * rays[i]), 0l, long(kMaxLinks)));
}

}  // namespace lumel
