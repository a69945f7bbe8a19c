// Stochastic radiosity by perspective ray bundles.
//
//   [BJ04]  A. Barsi, G. Jakab. Stream Processing in Global Illumination. CESCG 2004.
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on
//           the GPU. 2005.
//
// Solves  B = E + ρ T B  by stochastic iteration: T is replaced by a random T* with E[T* B] = T B
// that lets a few points shoot at all that they see, and the iterated values are averaged:
//
//     repeat
//         draw shooters y_k on lumels j_k with p_j ∝ 𝓛(X_j) A_j          select
//         see the world from y_k                                         look_from
//         for all lumels i:                                              receive
//             H_i += X_j A_j / (π p_j) V cosθ_i cosθ_j / r²     [BJ04] Eq. (3), [BSS05] Eq. (2)
//         now and then:  X ← from the running average           [BJ04] Eq. (2)   advance
//
// Cost of a step: K views of the occluders, and N × K point pairs.
//
// `Scheme::paper` with K = 1 is the papers' iteration, but for three things: points move over
// receivers and shooters instead of standing at their centres, the running average is kept in two
// halves for the error estimate, and T* acts on the average as in [BJ04] Eq. (2), not on the last
// value as in [BSS05].
//
// Differs from the papers else:
// - K shooters per iteration, drawn by an Owen-scrambled Sobol sequence.
// - Emission and reflected light are averaged apart: E never changes, so its mean is over all
//   shots; the reflected source X = ρH is frozen for phases of doubling length, and its overall
//   level is set by the energy balance at the end of each (stochastic.glsl).
// - Pairs of close lumels are taken out of the sampling and solved exactly (the near field).
// - Two half-solutions of independent sequences; their spread is the error estimate.

#include "solve/stochastic.h"

#include <algorithm>
#include <cmath>

#include "solve/lumel_arrays.h"

namespace lumel {
namespace {

constexpr std::uint32_t kSelectSpirv[] = {
#include "solve/stochastic.select.comp.inc"
};
constexpr std::uint32_t kReceiveSpirv[] = {
#include "solve/stochastic.receive.comp.inc"
};
constexpr std::uint32_t kBalanceSpirv[] = {
#include "solve/stochastic.balance.comp.inc"
};
constexpr std::uint32_t kEvaluateSpirv[] = {
#include "solve/stochastic.evaluate.comp.inc"
};
constexpr std::uint32_t kAdvanceSpirv[] = {
#include "solve/stochastic.advance.comp.inc"
};
constexpr std::uint32_t kPolishSpirv[] = {
#include "solve/stochastic.polish.comp.inc"
};

/// Shots of the first phase, all from E.
constexpr std::uint32_t kFirstPhaseShots = 64;
/// Share of shooters spread by area whatever their power (dark rooms need it).
constexpr float kDefensiveShare = 0.15f;
/// Shooters drawn from E, as a part of E's share of the power, and its bounds.
constexpr double kEmissionShooters = 0.5, kLeastEmission = 1.0 / 16.0, kMostEmission = 0.5;
/// How much a shot of an earlier phase counts beside one of the phase after it: its source was
/// less exact. The first phases hardly count.
constexpr float kEarlierWeight = 0.75f;
constexpr std::uint32_t kRoughPhases = 3;
constexpr float kRoughWeight = 0.25f;
/// The halves share the source of each phase and the near field, so their spread misses a part of
/// the error. Measured on the Cornell box over five seeds, the true error is this times the spread.
constexpr double kSharedError = 1.3;
/// The stated error is that of the whole map, or this part of the mean error of lumels relative to
/// their own light, if that is larger: a dark room beside a bright one counts too.
constexpr double kLocalShare = 0.6;
/// Light below this part of the map's mean counts as that much when relative errors are taken.
constexpr double kDimShare = 0.01;
/// Sweeps of the near field after the last shot.
constexpr int kPolishSweeps = 1;
/// Units tried first when a kind of work is timed (see gpu::Pacer).
constexpr std::uint32_t kProbeLumels = 4096;

constexpr gpu::Slot kReceiveSlots[] = {
    gpu::Slot::array,   gpu::Slot::array, gpu::Slot::constants, gpu::Slot::constants,
    gpu::Slot::texture, gpu::Slot::array, gpu::Slot::array};

}  // namespace

StochasticRadiosity::Kernels::Kernels(const gpu::Device& device, Projection projection)
    : select(device, "stochastic.select", kSelectSpirv, 8, sizeof(SelectParams), kSelectGroup),
      receive(device, "stochastic.receive", kReceiveSpirv, kReceiveSlots, sizeof(ReceiveParams),
              kReceiveGroup, std::uint32_t(projection)),
      balance(device, "stochastic.balance", kBalanceSpirv, 8, sizeof(AverageParams), kSumGroup),
      evaluate(device, "stochastic.evaluate", kEvaluateSpirv, 10, sizeof(AverageParams), kSumGroup),
      advance(device, "stochastic.advance", kAdvanceSpirv, 7, sizeof(AdvanceParams), kReceiveGroup),
      polish(device, "stochastic.polish", kPolishSpirv, 6, sizeof(PolishParams), kReceiveGroup)
{
}

StochasticRadiosity::StochasticRadiosity(const gpu::Device& device, const World& world,
                                         const Lumels& lumels, const NearField& near,
                                         const SolverOptions& options)
    : options_(options),
      count_(std::uint32_t(lumels.lumels.size())),
      batch_(std::clamp(std::uint32_t(std::max(options.batch, 1)), 1u, kMostBatch)),
      paper_(options.scheme == Scheme::paper),
      near_radius_(paper_ ? 0.0f : near.radius),
      reflecting_area_(reflecting_area(lumels)),
      emitted_power_(emitted_power(lumels, emission_of(lumels))),
      world_(&world),
      kernels_(device, options.projection),
      views_(device, world, options.projection, std::uint32_t(options.hemicube), batch_),
      eyes_(device, kMostBatch),
      shots_(device, kMostBatch),
      surface_(device, view(surfaces_of(lumels))),
      emission_(device, view(emission_of(lumels))),
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
      emission_power_pyramid_(device, count_),
      source_power_pyramid_(device, count_),
      pacer_(device)
{
    batch_ = std::min(batch_, views_.capacity());
    phase_length_ = paper_ ? 1 : std::max(2u, kFirstPhaseShots / batch_);

    pacer_.work("prepare", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        for (const auto* array : {&source_, &direct_, &indirect_, &earlier_, &near_emission_,
                                  &near_source_, &far_, &irradiance_})
            commands.fill(array->buffer());
        if (!paper_)
            near_rows_.light(commands, emission_, near_emission_);
        emission_power_pyramid_.build(commands, emission_, surface_, 0.0f, 0.0f);
        if (paper_) {  // the first source is E alone
            commands.copy(emission_.buffer(), source_.buffer(), count_ * sizeof(glm::vec3));
            source_power_pyramid_.build(commands, source_, surface_, 0.0f, 0.0f);
        }
    });
}

Averages StochasticRadiosity::averages() const
{
    Averages a{};
    for (int h = 0; h < 2; ++h) {
        a.emission_shots[h] = float(emission_index_[h]);
        a.source_shots[h] = phase_source_shots_[h];
        a.earlier_weight[h] = earlier_weight_[h];
    }
    a.balance = paper_ ? 0u : 1u;
    return a;
}

void StochasticRadiosity::step()
{
    take_figures();
    shoot();
    ++state_.iterations;
    state_.shots += batch_;
    if (++phase_batch_ == phase_length_)
        advance();
    if (state_.iterations >= 2)
        figures_.ask(pacer_, state_.iterations,
                     [&](gpu::Commands& commands) { evaluate(commands); });
}

std::uint32_t StochasticRadiosity::emission_shots_of_batch()
{
    if (paper_)
        return 0;
    if (phase_ == 0)
        return batch_;
    emission_owed_ += emission_share_ * batch_;
    const auto whole = std::uint32_t(std::min(std::floor(emission_owed_), double(batch_)));
    emission_owed_ -= whole;
    return whole;
}

void StochasticRadiosity::select(gpu::Commands& commands, std::uint32_t emission_shots)
{
    const std::uint32_t h = phase_batch_ % 2;
    const SelectParams params{.layout_ = emission_power_pyramid_.layout(),
                              .count = batch_,
                              .emission_count = emission_shots,
                              .emission_index = emission_index_[h],
                              .source_index = source_index_[h],
                              .seed = options_.seed * 2 + h,
                              .random = paper_ ? 1u : 0u,
                              .disc = paper_ && options_.disc ? 1u : 0u,
                              .centre = options_.rule == SampleRule::centre ? 1u : 0u};
    commands.dispatch(kernels_.select,
                      {world_->lumels(), world_->pieces(), emission_, source_,
                       emission_power_pyramid_.array(), source_power_pyramid_.array(), eyes_,
                       shots_},
                      params, batch_);
}

void StochasticRadiosity::shoot()
{
    const std::uint32_t emission_shots = emission_shots_of_batch();
    const std::uint32_t h = phase_batch_ % 2;
    pacer_.work("select", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        select(commands, emission_shots);
    });
    views_.look_from(pacer_, eyes_, batch_);
    pacer_.work("receive", count_, kProbeLumels,
                [&](gpu::Commands& commands, std::uint32_t first, std::uint32_t last) {
                    const ReceiveParams params{.views = views_.layout(),
                                               .first = first,
                                               .last = last,
                                               .count = count_,
                                               .shots = batch_,
                                               .emission_shots = emission_shots,
                                               .half_ = h,
                                               .iteration = std::uint32_t(state_.iterations),
                                               .seed = options_.seed,
                                               .centre =
                                                   options_.rule == SampleRule::centre ? 1u : 0u,
                                               .near_radius = near_radius_};
                    commands.dispatch(kernels_.receive,
                                      {world_->lumels(),
                                       world_->pieces(),
                                       eyes_,
                                       shots_,
                                       {views_.image(), views_.sampler()},
                                       direct_,
                                       indirect_},
                                      params, last - first);
                });
    emission_index_[h] += emission_shots;
    source_index_[h] += batch_ - emission_shots;
    phase_source_shots_[h] += float(batch_ - emission_shots);
}

void StochasticRadiosity::evaluate(gpu::Commands& commands)
{
    const AverageParams params{averages(), count_, float(kDimShare * mean_irradiance_)};
    if (!paper_) {
        commands.dispatch(kernels_.balance,
                          {surface_, direct_, indirect_, near_emission_, near_source_, source_,
                           earlier_, figures_.parts()},
                          params, count_);
        figures_.add_up(commands, totals_);
    }
    commands.dispatch(kernels_.evaluate,
                      {surface_, direct_, indirect_, near_emission_, near_source_, earlier_,
                       totals_, far_, irradiance_, figures_.parts()},
                      params, count_);
    figures_.add_up(commands);
}

void StochasticRadiosity::advance()
{
    const bool end_phase = !paper_;
    pacer_.work("advance", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        evaluate(commands);
        commands.dispatch(kernels_.advance,
                          {surface_, emission_, irradiance_, totals_, indirect_, earlier_, source_},
                          AdvanceParams{averages(), count_, end_phase ? 1u : 0u, paper_ ? 1u : 0u},
                          count_);
        if (!paper_)
            near_rows_.light(commands, source_, near_source_);
    });
    pacer_.work("power", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        source_power_pyramid_.build(commands, source_, surface_, paper_ ? 0.0f : kDefensiveShare,
                                    reflecting_area_);
    });
    phase_batch_ = paper_ ? phase_batch_ : 0;
    if (paper_) {
        phase_length_ = phase_batch_ + 1;
        return;
    }
    const float forget = phase_ < kRoughPhases ? kRoughWeight : kEarlierWeight;
    for (int h = 0; h < 2; ++h) {
        earlier_weight_[h] = forget * (earlier_weight_[h] + phase_source_shots_[h]);
        phase_source_shots_[h] = 0.0f;
    }
    if (phase_ > 0)
        phase_length_ *= 2;
    ++phase_;
    emission_share_ = std::min(emission_share_, kMostEmission);
}

void StochasticRadiosity::take_figures()
{
    const std::optional<Terms> terms = figures_.take(pacer_, state_.iterations);
    if (!terms)
        return;
    const glm::vec4 sums = terms->column[0];
    const double count = 3.0 * double(sums.z);
    if (!(sums.y > 0.0f) || count <= 0.0) {
        // A scene without light is solved at once, and one that catches none of it soon.
        state_.error = emitted_power_ > 0.0 && phase_ <= 1 ? -1.0 : 0.0;
        return;
    }
    mean_irradiance_ = double(sums.y) / count;
    const double local = std::sqrt(double(terms->column[1].x) / count);
    if (paper_ || phase_ > 1)
        state_.error = kSharedError * std::max(std::sqrt(double(sums.x) / count) / mean_irradiance_,
                                               kLocalShare * local);
    const double share = emitted_power_ / (emitted_power_ + double(sums.w));
    emission_share_ = std::clamp(kEmissionShooters * share, kLeastEmission, kMostEmission);
}

std::vector<glm::vec3> StochasticRadiosity::irradiance()
{
    pacer_.work("polish", 1, 1, [&](gpu::Commands& commands, std::uint32_t, std::uint32_t) {
        evaluate(commands);
        if (paper_)
            return;
        const auto sweep = [&](const gpu::Array<glm::vec3>& near) {
            commands.dispatch(kernels_.polish,
                              {surface_, far_, near_emission_, near, irradiance_, scratch_source_},
                              PolishParams{count_}, count_);
        };
        sweep(near_source_);
        for (int i = 0; i < kPolishSweeps; ++i) {
            near_rows_.light(commands, scratch_source_, scratch_near_);
            sweep(scratch_near_);
        }
    });
    pacer_.finish();
    return irradiance_.download();
}

}  // namespace lumel
