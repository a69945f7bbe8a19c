// The iteration scheme.
//
//   [BJ04]  A. Barsi, G. Jakab. Stream Processing in Global Illumination. CESCG 2004.
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on
//           the GPU. 2005.
//   [TN11]  A. Thomsen, K. Nielsen. Approximate Radiosity Using Stochastic Depth Buffering. 2011.
//
// Solves  B = E + ρ T B  where T is known through a random T* with E[T* B] = T B.
//
// `Scheme::paper`: T* acts on the running average, [BJ04] Eq. (2). The average is kept in two
// halves for the error estimate. IterationOptions::leak makes it the leaky integration of [TN11]
// Figure 6, where the weight of a shot decays with every later one: the solution follows changes of
// the light and stays noisy.
//
// `Scheme::phased` differs:
// - Emission and reflected light are averaged separately. E is constant, so its mean is over all
//   shots. The reflected source X = ρH is frozen for phases of doubling length; the energy balance
//   scales it at the end of each phase (iteration.glsl).
// - Near-field pairs, left out of T*, are added exactly.
// - The error is estimated from the spread of two half-solutions with independent sequences.

#include "solve/shooting/iteration.h"

#include <algorithm>
#include <cmath>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Shots of the first phase, all from E.
constexpr std::uint32_t kFirstPhaseShots = 64;
/// Weight of a shot relative to one of the next phase, whose source is more accurate. The first
/// phases have little weight.
constexpr float kEarlierWeight = 0.75f;
constexpr std::uint32_t kRoughPhases = 3;
constexpr float kRoughWeight = 0.25f;
/// The halves share the source of each phase and the near field, so their spread misses a part of
/// the error. Factor from spread to true error, measured on the Cornell box over five seeds.
constexpr double kSharedError = 1.3;
/// The estimated error is that of the whole map, given irradiance included, or this fraction of the
/// mean relative error of lumels if that is larger: a dark room beside a bright one counts too.
constexpr double kLocalShare = 0.6;
/// Relative errors of darker lumels are relative to this fraction of the map's mean.
constexpr double kDimShare = 0.01;
/// Sweeps of the near field after the last shot.
constexpr int kPolishSweeps = 1;

/// Fraction of the earlier sums that remains after a batch.
double kept_by_batch(const IterationOptions& options, std::uint32_t batch)
{
    if (options.leak == 0.0)
        return 1.0;
    if (!(options.leak > 0.0) || options.leak >= 1.0 || options.scheme != Scheme::paper)
        throw Error(ErrorKind::input, "a leak of " + std::to_string(options.leak),
                    "must be from 0 to below 1, and needs the papers' scheme");
    return std::pow(1.0 - options.leak, double(batch));
}

}  // namespace

Iteration::Iteration(const gpu::Device& device, const Lumels& lumels, const NearField& near,
                     std::span<const glm::vec3> known, const IterationOptions& options,
                     std::uint32_t batch)
    : count_(std::uint32_t(lumels.lumels.size())),
      batch_(batch),
      paper_(options.scheme == Scheme::paper),
      kept_(kept_by_batch(options, batch)),
      emitted_power_(emitted_power(lumels, emission_of(lumels))),
      known_sum_(irradiance_sum(known)),
      balance_(device),
      evaluate_(device),
      advance_(device),
      polish_(device),
      fade_(device),
      surface_(device, view(surfaces_of(lumels))),
      emission_(device, view(emission_of(lumels))),
      known_(device, count_),
      source_(device, count_),
      direct_(device, 2 * count_),
      indirect_(device, 2 * count_),
      earlier_(device, 2 * count_),
      near_emission_(device, count_),
      near_source_(device, count_),
      far_(device, count_),
      irradiance_(device, count_),
      scratch_source_(device, count_),
      scratch_near_(device, count_),
      near_rows_(device, near, count_),
      totals_(device, 1),
      figures_(device, count_),
      phase_length_(paper_ ? 1 : std::max(2u, kFirstPhaseShots / batch))
{
    if (!known.empty())
        known_.upload(known);
}

void Iteration::begin(gpu::Pacer& pacer)
{
    pacer.work("prepare", [&](gpu::Commands& commands) {
        for (const auto* array : {&source_, &direct_, &indirect_, &earlier_, &near_emission_,
                                  &near_source_, &far_, &irradiance_})
            commands.fill(array->buffer());
        if (known_sum_ == 0.0)
            commands.fill(known_.buffer());
        if (paper_)
            commands.copy(emission_.buffer(), source_.buffer(), count_ * sizeof(glm::vec3));
        else
            near_rows_.light(commands, emission_, near_emission_);
    });
}

void Iteration::start_from(gpu::Pacer& pacer, std::span<const glm::vec3> source)
{
    pacer.finish();
    source_.upload(source);
    pacer.work("prepare",
               [&](gpu::Commands& commands) { near_rows_.light(commands, source_, near_source_); });
    phase_ = kRoughPhases;  // the guess is better than the sources of these
}

Averages Iteration::averages() const
{
    Averages a{};
    // Averaged over both halves, a batch then has the weight 1 - kept, in either half.
    const auto leaky = float(0.5 * double(batch_) / (1.0 - kept_));
    for (int h = 0; h < 2; ++h) {
        a.emission_shots[h] = leaks() ? leaky : float(emission_index_[h]);
        a.source_shots[h] = leaks() ? leaky : phase_source_shots_[h];
        a.earlier_weight[h] = earlier_weight_[h];
    }
    a.balance = paper_ ? 0u : 1u;
    return a;
}

bool Iteration::finish_batch(gpu::Pacer& pacer, std::uint32_t emission_shots,
                             std::uint32_t source_shots)
{
    const std::uint32_t h = half();
    emission_index_[h] += emission_shots;
    source_index_[h] += source_shots;
    phase_source_shots_[h] += float(source_shots);
    ++state_.iterations;
    state_.shots += batch_;
    ++phase_batch_;
    const bool phase_ends = phase_batch_ == phase_length_;
    if (phase_ends)
        advance(pacer);
    if (state_.iterations >= 2)
        figures_.request(pacer, state_.iterations,
                         [&](gpu::Commands& commands) { evaluate(commands); });
    return phase_ends;
}

void Iteration::evaluate(gpu::Commands& commands)
{
    const AverageParams params{averages(), count_, float(kDimShare * mean_irradiance_)};
    if (!paper_) {
        commands.dispatch(balance_,
                          {.surface = surface_,
                           .direct = direct_,
                           .indirect = indirect_,
                           .near_emission = near_emission_,
                           .near_source = near_source_,
                           .source = source_,
                           .earlier = earlier_,
                           .parts = figures_.parts()},
                          params, count_);
        figures_.add_up(commands, totals_);
    }
    commands.dispatch(evaluate_,
                      {.totals = totals_,
                       .surface = surface_,
                       .direct = direct_,
                       .indirect = indirect_,
                       .near_emission = near_emission_,
                       .near_source = near_source_,
                       .earlier = earlier_,
                       .known = known_,
                       .far = far_,
                       .irradiance = irradiance_,
                       .parts = figures_.parts()},
                      params, count_);
    figures_.add_up(commands);
}

void Iteration::advance(gpu::Pacer& pacer)
{
    pacer.work("advance", [&](gpu::Commands& commands) {
        evaluate(commands);
        commands.dispatch(advance_,
                          {.totals = totals_,
                           .surface = surface_,
                           .emission = emission_,
                           .irradiance = irradiance_,
                           .indirect = indirect_,
                           .earlier = earlier_,
                           .source = source_},
                          AdvanceParams{averages(), count_, paper_ ? 0u : 1u, paper_ ? 1u : 0u},
                          count_);
        if (!paper_)
            near_rows_.light(commands, source_, near_source_);
    });
    if (paper_)
        phase_length_ = phase_batch_ + 1;
    else
        end_phase();
}

void Iteration::end_phase()
{
    phase_batch_ = 0;
    const float forget = phase_ < kRoughPhases ? kRoughWeight : kEarlierWeight;
    for (int h = 0; h < 2; ++h) {
        earlier_weight_[h] = forget * (earlier_weight_[h] + phase_source_shots_[h]);
        phase_source_shots_[h] = 0.0f;
    }
    if (phase_ > 0)
        phase_length_ *= 2;
    ++phase_;
}

std::uint64_t Iteration::device_bytes(std::size_t lumel_count, std::uint64_t near_pairs)
{
    constexpr std::uint64_t kVectors = 9, kHalves = 3;  // arrays of vec3 [N] and [2][N]
    return lumel_count * (sizeof(glm::vec4) + (kVectors + 2 * kHalves) * sizeof(glm::vec3)) +
           NearRows::device_bytes(lumel_count, near_pairs) + LumelSums::device_bytes(lumel_count) +
           sizeof(Terms);
}

void Iteration::begin_batch(gpu::Pacer& pacer)
{
    take_figures(pacer);
    if (leaks())
        pacer.dispatch("fade", fade_, {.direct = direct_, .indirect = indirect_},
                       FadeParams{2 * count_, float(kept_)}, 2 * count_);
}

void Iteration::relight(gpu::Pacer& pacer, const Lumels& lumels)
{
    if (!leaks())
        throw Error(ErrorKind::input, "changing light",
                    "needs a leak: the mean of all shots keeps earlier light");
    pacer.finish();
    const std::vector<glm::vec3> emission = emission_of(lumels);
    emission_.upload(emission);
    surface_.upload(surfaces_of(lumels));
    emitted_power_ = emitted_power(lumels, emission);
    advance(pacer);
}

void Iteration::take_figures(gpu::Pacer& pacer)
{
    const std::optional<Terms> terms = figures_.poll(pacer, state_.iterations);
    if (!terms)
        return;
    const glm::vec4 sums = terms->column[0];
    const double count = 3.0 * double(sums.z);
    if (!(sums.y > 0.0f) || count <= 0.0) {
        // A scene without light has converged at once, one that receives none after the first
        // phases.
        state_.error = emitted_power_ > 0.0 && phase_ <= 1 ? -1.0 : 0.0;
        return;
    }
    mean_irradiance_ = (double(sums.y) + known_sum_) / count;
    const double local = std::sqrt(double(terms->column[1].x) / count);
    if (paper_ || phase_ > 1)
        state_.error = kSharedError * std::max(std::sqrt(double(sums.x) / count) / mean_irradiance_,
                                               kLocalShare * local);
    emission_share_ = emitted_power_ / (emitted_power_ + double(sums.w));
}

std::vector<glm::vec3> Iteration::irradiance(gpu::Pacer& pacer)
{
    pacer.work("polish", [&](gpu::Commands& commands) {
        evaluate(commands);
        if (paper_)
            return;
        const auto sweep = [&](const gpu::Array<glm::vec3>& near) {
            commands.dispatch(polish_,
                              {.surface = surface_,
                               .far = far_,
                               .near_emission = near_emission_,
                               .near_source = near,
                               .irradiance = irradiance_,
                               .source = scratch_source_},
                              CountParams{count_}, count_);
        };
        sweep(near_source_);
        for (int i = 0; i < kPolishSweeps; ++i) {
            near_rows_.light(commands, scratch_source_, scratch_near_);
            sweep(scratch_near_);
        }
    });
    pacer.finish();
    return irradiance_.download();
}

}  // namespace lumel
