// LinkRadiosity's rounds: what follows an estimate, until the errors asked for are reached.

#include <algorithm>
#include <cmath>

#include "links/trace/links.h"

namespace lumel {
namespace {

/// Maximum rays of a later round, relative to the rays so far.
constexpr double kMaxAdded = 3.0;
/// Least and most rays of a noisy chart after a round, relative to those so far. They aim for this
/// fraction of the target variance: a further round costs more than they do.
constexpr double kLeastOfChart = 2.0, kMostOfChart = 16.0, kAim = 0.5;
/// Rays allocated by deviation reduce the variance like 1 / kAdaptiveGain as many uniform ones.
constexpr double kAdaptiveGain = 0.6;
/// Fraction of the remaining rays that the second round sends if the target errors need all of
/// them: the first round's errors are too rough to share out the rest. Where charts are noisy to
/// the eye, one round did better.
constexpr double kOfLimit = 0.3;
/// Refines direct light if its variance is this multiple of its target; at most to kMinDirect × the
/// present variance in one pass.
constexpr double kTooUncertain = 1.25, kMinDirect = 1.0 / 16.0;
/// A pass helped if its variance is below this multiple of that before.
constexpr double kHelped = 0.9;
/// The light is that of the bake if errors before a pass differ by at most this: sweeps leave less.
constexpr double kSameLight = 0.01;
/// Cost of a link relative to a shadow ray, sweeps and filter included.
constexpr double kCostOfLink = 1.5;
/// Variance of rays after a round that adds kMaxAdded, relative to that before.
constexpr double kNextRound = 1.0 / (1.0 + kMaxAdded);
/// Bounds on the fraction of the target variance that direct light may have.
constexpr double kMinShare = 0.1, kMaxShare = 0.6;
/// Residual at which sweeps stop, relative to each sub-lumel's light: this fraction of the smallest
/// target error, but at least kResidual.
constexpr double kResidual = 1e-3, kResidualOfTarget = 0.05;
}  // namespace

/// Target errors, with current values.
std::vector<LinkRadiosity::Wanted> LinkRadiosity::wanted() const
{
    std::vector<Wanted> result;
    const auto add = [&](double target, ErrorOf of) {
        if (target > 0.0)
            result.push_back({target, of, errors(of)});
    };
    add(target_error_, ErrorOf::all);
    add(target_dark_error_, ErrorOf::dark);
    add(target_eye_error_, ErrorOf::eye);
    add(target_visible_noise_, ErrorOf::chart);
    return result;
}

/// Starts the next stage: repeats a stored pass, refines direct light, or adds links.
void LinkRadiosity::go_on()
{
    if (repeat_pass())
        return;
    const std::vector<Wanted> all = wanted();
    const bool reached = std::ranges::all_of(all, &Wanted::is_reached);
    const bool is_even = options_.even_rays > 0;
    if (is_even) {
        end();
        return;
    }
    if (reached && !all.empty()) {
        stage_ = Stage::direct;  // without work
        return;
    }
    if (refine_direct())
        stage_ = Stage::direct;
    else if (stored_ && then_ == Then::end)
        end();
    else
        begin_round();
}

/// Fraction of the target variance for direct light. For variances that fall as 1 / rays, the total
/// cost is minimal if they are in proportion to √(variance × cost).
double LinkRadiosity::share_of_direct(const Errors& now) const
{
    const double of_rays = kCostOfLink * now.rays * double(state_.shots * work_.order.size());
    const double of_direct = now.direct * double(direct_->rays());
    const double root = std::sqrt(of_direct), sum = root + std::sqrt(of_rays);
    return sum > 0.0 ? std::clamp(root / sum, kMinShare, kMaxShare) : kMaxShare;
}

/// Schedules refinement of direct light if its noise dominates: beside that of the rays after the
/// next round, as long as they are above the target; and as long as it helps.
bool LinkRadiosity::refine_direct()
{
    std::vector<Wanted> all = wanted();
    // Beside the rays, whatever is asked for: few lumels near a lamp can hold most of the noise.
    const Errors& whole = errors(ErrorOf::all);
    all.push_back({std::sqrt(whole.rays), ErrorOf::all, whole});
    double share = 1.0;
    const Wanted* tightest = nullptr;
    for (const Wanted& one : all) {
        const double most =
            share_of_direct(one.now) * std::max(one.error * one.error, kNextRound * one.now.rays);
        const double left = std::max(most / one.now.direct, kMinDirect);
        const double before = refined_[one.is_visible() ? 1 : 0];
        const bool helps = before == 0.0 || one.now.direct < kHelped * before;
        if (one.now.direct > kTooUncertain * most && left < share && helps) {
            share = left;
            tightest = &one;
        }
    }
    if (!tightest)
        return false;
    // By the variance that the filter leaves, as rays are allocated.
    std::vector<double> weight = tightest->is_visible() ? chart_weights() : weights();
    if (const ChartFilter* const by = filter()) {
        const Mean plain = plain_mean(direct_->half(0), direct_->half(1));
        const std::vector<double> left =
            by->variance_left({plain.noise.begin(), plain.noise.end()},
                              {direct_mean_.noise.begin(), direct_mean_.noise.end()});
        for (std::size_t i = 0; i < weight.size(); ++i)
            weight[i] *= left[i];
    }
    const bool refines = direct_->refine(share, state_.shots * work_.order.size(), weight);
    if (refines)
        add_pass(tightest->of, tightest->now.direct);
    return refines;
}

/// Keeps the pass of direct light that begins. aim: the error that it lowers; before: its square.
void LinkRadiosity::add_pass(ErrorOf aim, double before)
{
    passes_.push_back({round_, aim, before, direct_->levels()});
    refined_[aim == ErrorOf::chart ? 1 : 0] = before;
}

/// Begins the next pass of a former bake that came before the present round.
bool LinkRadiosity::repeat_pass()
{
    const std::size_t next = passes_.size();
    if (!stored_ || next >= stored_->passes.size())
        return false;
    const StoredLinks::Pass& pass = stored_->passes[next];
    const bool is_of_other_atlas = pass.levels.size() != work_.order.size();
    if (is_of_other_atlas || pass.rounds > round_)
        return false;
    const bool is_same_light =
        std::abs(errors(pass.aim).direct - pass.before) <= kSameLight * pass.before;
    direct_->refine_to(pass.levels);
    add_pass(pass.aim, pass.before);
    // Unknown until the light is that of the bake, or a looser target would end the state before.
    state_.error = state_.dark_error = state_.eye_error = -1.0;
    state_.visible_noise = {};
    // Whether a pass helped under the light of the bake says nothing about another.
    if (!is_same_light)
        refined_ = {};
    stage_ = Stage::direct;
    return true;
}

/// Ends the solution as it is.
void LinkRadiosity::end()
{
    state_.ended = true;
    stage_ = Stage::direct;  // without work
}

/// Starts a round with the rays that the target error requires, within limits.
void LinkRadiosity::begin_round()
{
    if (has_known_round()) {
        if (!repeat_pass())
            begin_known_round();
        return;
    }
    if (most_shots_ > 0 && state_.shots >= most_shots_) {
        end();
        return;
    }
    const double fit = rays_that_fit();
    double most = options_.even_rays > 0 ? double(kMaxLinks) : std::max(fit, double(kFirstRays));
    if (most_shots_ > 0)
        most = std::min(most, double(most_shots_ - state_.shots) / double(kSolutions));
    if (state_.shots == 0) {
        send_first_rays(most);
    } else {
        const double so_far = double(state_.shots) / double(kSolutions);
        state_.full = fit < kMinAdded * so_far;
        if (round_ == 1 && noisy_charts().empty() && more_rays() >= most)
            most *= kOfLimit;
        if (!state_.full)
            share_out_rays(most);
        state_.ended = !state_.full && !(mean_rays_ > 0.0);
        if (state_.full || state_.ended) {
            stage_ = Stage::direct;  // without work
            return;
        }
        if (more_rays() > 0.0)
            leave_sealed_space();
    }
    refined_ = {};
    filter_.reset();
    begin_links();
}

/// [P] 1 for sub-lumels that send light or receive some.
std::vector<char> LinkRadiosity::lit_parts() const
{
    std::vector<char> lit(parts_->count(), 0);
    for (std::uint32_t p = 0; p < lit.size(); ++p) {
        lit[p] = work_.lumels()[parts_->lumel(p)].emission != glm::vec3(0.0f);
        for (const std::vector<glm::vec3>& received : received_)
            lit[p] |= received[p] != glm::vec3(0.0f);
    }
    for (std::size_t i = 0; i < work_.lumels().size(); ++i)
        for (std::uint32_t c = 0; c < std::uint32_t(kCells); ++c)
            if (direct_->at(i, c) != glm::vec3(0.0f))
                lit[parts_->part(i, c)] = 1;
    return lit;
}

/// Lumels that no light can reach send no more rays: as long as no link, theirs or one to them,
/// joins them with light.
void LinkRadiosity::leave_sealed_space()
{
    const std::vector<char> lit = lit_parts();
    if (std::find(lit.begin(), lit.end(), 0) == lit.end())
        return;
    for (std::size_t k = 0; k < kSolutions; ++k)
        sealed_->join(*links_[k], k);
    const std::vector<char> sealed = sealed_->sealed(lit);
    for (std::size_t i = 0; i < sealed.size(); ++i)
        if (sealed[i])
            for (std::vector<std::uint16_t>& rays : rays_)
                rays[i] = 0;
}

/// Further rays per lumel and solution for the target errors, except that of visible noise.
double LinkRadiosity::more_rays() const
{
    const double so_far = double(state_.shots) / double(kSolutions);
    const std::vector<Wanted> all = wanted();
    if (all.empty())
        return std::min(so_far, double(kMaxLinks));
    double ratio = 0.0;
    for (const Wanted& one : all)
        if (!one.is_visible() && !one.is_reached()) {
            const double square = one.error * one.error;
            const double left = square - std::min(one.now.direct, kMaxShare * square);
            ratio = std::max(ratio, one.now.rays / left);
        }
    if (!(ratio > 0.0))
        return 0.0;
    const double more = kAdaptiveGain * so_far * (ratio - 1.0);
    return std::min(std::clamp(more, kMinAdded * so_far, kMaxAdded * so_far), double(kMaxLinks));
}

/// All rays of a chart for its visible noise, relative to those so far; 1 if rays are not what it
/// lacks.
double LinkRadiosity::rays_for(const ChartNoise& chart) const
{
    const double square = kAim * target_visible_noise_ * target_visible_noise_;
    double ratio = 0.0;
    for (std::size_t band = 0; band < VisibleNoise::kBands; ++band) {
        const Errors now = errors_in(chart, band);
        ratio = std::max(ratio, now.rays / (square - std::min(now.direct, kMaxShare * square)));
    }
    return ratio > 1.0 ? std::clamp(ratio, kLeastOfChart, kMostOfChart) : 1.0;
}

/// Residual at which sweeps stop, relative to each sub-lumel's light: far below the target errors.
double LinkRadiosity::sweep_residual() const
{
    double target = 0.0;
    for (const Wanted& one : wanted())
        target = target > 0.0 ? std::min(target, one.error) : one.error;
    return std::max(kResidual, kResidualOfTarget * target);
}

}  // namespace lumel
