// Stochastic radiosity by perspective ray bundles.
//
//   [BJ04]  A. Barsi, G. Jakab. Stream Processing in Global Illumination. CESCG 2004.
//   [BSS05] A. Barsi, L. Szirmay-Kalos, G. Szijártó. Stochastic Glossy Global Illumination on
//           the GPU. 2005.
//
// Solves  B = E + ρ T B  by stochastic iteration: T is replaced by a random T* with E[T* B] = T B
// in which a few points shoot at all that they see, and the iterated values are averaged:
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
// `Scheme::paper` with K = 1, SampleRule::centre and Projection::hemisphere is the iteration of
// [BJ04], except for the test of visibility, which compares planes and depths (sees.glsl) where the
// paper compares depths within 0.05: T* acts on the running average. In [BSS05] it acts on the last
// value; that iteration is in GlossyIllumination.
//
// Scheme::phased differs from [BJ04]:
// - Points move over receivers and shooters, except with SampleRule::centre.
// - K shooters per iteration are drawn by an Owen-scrambled Sobol sequence.
// - The iteration is in phases (iteration.cpp); a share of the shooters is drawn from E alone.
// - Pairs of close lumels are taken out of the sampling and solved exactly (the near field).

#include "methods/stochastic/stochastic.h"

#include <algorithm>
#include <cmath>

#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Fraction of shooters drawn from E, relative to E's fraction of the power, and its bounds.
constexpr double kEmissionShooters = 0.5, kMinEmission = 1.0 / 16.0, kMaxEmission = 0.5;

}  // namespace

StochasticRadiosity::StochasticRadiosity(const gpu::Device& device, const World& world,
                                         const Lumels& lumels, const NearField& near,
                                         const StochasticOptions& options,
                                         std::span<const glm::vec3> known, OtherLight other)
    : options_(options),
      atlas_width_(std::uint32_t(lumels.width)),
      paper_(options.iteration.scheme == Scheme::paper),
      near_radius_(paper_ ? 0.0f : near.radius),
      reflecting_area_(reflecting_area(lumels)),
      world_(&world),
      select_(device),
      receive_(device, std::uint32_t(options.views.projection)),
      views_(device, world, options.views.projection, std::uint32_t(options.views.hemicube),
             std::uint32_t(options.views.batch)),
      batch_(views_.capacity()),
      eyes_(device, kMaxBatch),
      shots_(device, kMaxBatch),
      iteration_(device, lumels, near, known, options.iteration, batch_),
      other_(std::move(other)),
      emission_power_pyramid_(device, lumels.lumels.size()),
      source_power_pyramid_(device, lumels.lumels.size()),
      pacer_(device)
{
    iteration_.begin(pacer_);
    pacer_.work("power", [&](gpu::Commands& commands) {
        emission_power_pyramid_.build(commands, iteration_.emission(), iteration_.surface(), 0.0f,
                                      0.0f);
    });
    if (paper_)  // the first source is E alone
        build_source_pyramid();
}

void StochasticRadiosity::build_source_pyramid()
{
    pacer_.work("power", [&](gpu::Commands& commands) {
        source_power_pyramid_.build(commands, iteration_.source(), iteration_.surface(),
                                    paper_ ? 0.0f : kDefensiveShare, reflecting_area_);
    });
}

void StochasticRadiosity::start_from(std::span<const glm::vec3> source)
{
    iteration_.start_from(pacer_, source);
    build_source_pyramid();
}

std::uint64_t StochasticRadiosity::device_bytes(const SolveSize& size,
                                                const StochasticOptions& options)
{
    const std::size_t count = size.count();
    return EyeViews::device_bytes(options.views.projection, std::uint32_t(options.views.hemicube),
                                  std::uint32_t(options.views.batch)) +
           kMaxBatch * (sizeof(Eye) + sizeof(Shot)) +
           Iteration::device_bytes(count, size.near_pairs) + 2 * PowerPyramid::device_bytes(count);
}

void StochasticRadiosity::step()
{
    iteration_.begin_batch(pacer_);
    const std::uint32_t emission_shots = emission_shots_of_batch();
    select(emission_shots);
    views_.look_from(pacer_, eyes_, batch_);
    receive(emission_shots);
    if (other_)
        other_(pacer_, iteration_, emission_shots);
    if (iteration_.finish_batch(pacer_, emission_shots, batch_ - emission_shots))
        build_source_pyramid();
}

std::uint32_t StochasticRadiosity::emission_shots_of_batch()
{
    if (paper_)
        return 0;
    if (!iteration_.sends_reflected())
        return batch_;
    const double share =
        std::clamp(kEmissionShooters * iteration_.emission_share(), kMinEmission, kMaxEmission);
    emission_owed_ += share * batch_;
    const auto whole = std::uint32_t(std::min(std::floor(emission_owed_), double(batch_)));
    emission_owed_ -= whole;
    return whole;
}

void StochasticRadiosity::select(std::uint32_t emission_shots)
{
    const std::uint32_t h = iteration_.half();
    const SelectParams params{.pyramid = emission_power_pyramid_.layout(),
                              .count = batch_,
                              .emission_count = emission_shots,
                              .emission_index = iteration_.emission_index(),
                              .source_index = iteration_.source_index(),
                              .seed = options_.seed * 2 + h,
                              .random = paper_ ? 1u : 0u,
                              .disc = paper_ && options_.disc ? 1u : 0u,
                              .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                              .merge = paper_ ? options_.merge : 0u,
                              .width = atlas_width_,
                              .channels = world_->has_coloured_glass() ? 1u : 0u};
    pacer_.dispatch("select", select_,
                    {.lumels = world_->lumels(),
                     .pieces = world_->pieces(),
                     .emission = iteration_.emission(),
                     .source = iteration_.source(),
                     .emission_power = emission_power_pyramid_.array(),
                     .source_power = source_power_pyramid_.array(),
                     .eyes = eyes_,
                     .shots = shots_},
                    params, batch_);
}

void StochasticRadiosity::receive(std::uint32_t emission_shots)
{
    pacer_.dispatch_parts("receive", iteration_.lumels(), kProbeLumels, receive_,
                          {.lumels = world_->lumels(),
                           .pieces = world_->pieces(),
                           .views = {views_.image(), views_.sampler()},
                           .eyes = eyes_,
                           .shots = shots_,
                           .direct = iteration_.direct(),
                           .indirect = iteration_.indirect()},
                          {.views = views_.layout(),
                           .count = iteration_.lumels(),
                           .shots = batch_,
                           .emission_shots = emission_shots,
                           .half_index = iteration_.half(),
                           .iteration = std::uint32_t(iteration_.state().iterations),
                           .seed = options_.seed,
                           .centre = options_.rule == SampleRule::centre ? 1u : 0u,
                           .near_radius = near_radius_});
}

}  // namespace lumel
