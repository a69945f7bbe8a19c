// The default scheme: diffuse light by the phases of iteration.cpp, lobes by particles.
//
//     H = (T + P)(E + ρ_d H),
//
// T: shooters and near pairs (stochastic.cpp), P: lobes (phase_particles.cpp). All batches count:
// the energy balance sets the level of the light. Unlike [BSS05], whose T* acts on the last value,
// no iteration starts from the noise of the one before. A frame of a moved scene starts its phases
// from the mean of the one before. The first frame of an eye or of other emission leaves the phases
// and continues from their mean (glossy_frames.cpp).

#include <algorithm>

#include "methods/glossy/glossy.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Shooters per particle and lumel.
constexpr std::size_t kShootersPerPhaseParticle = 2;

std::size_t particles_per_batch(std::size_t lumels, std::uint32_t batch)
{
    return std::size_t(batch) * lumels / kShootersPerPhaseParticle;
}

/// Particles per lumel by which the power that lobes reflect is found.
constexpr std::size_t kParticlesOfBalance = 1024;

/// The lumels with what they reflect diffusely alone.
Lumels matte(Lumels lumels)
{
    for (std::size_t i = 0; i < lumels.lumels.size(); ++i)
        lumels.lumels[i].albedo = lumels.gloss[i].diffuse;
    return lumels;
}

}  // namespace

std::uint64_t GlossyIllumination::host_bytes(std::size_t lumels, const GlossyOptions& options)
{
    if (options.scheme == Scheme::paper)
        return 0;
    return LobeParticles::host_bytes(
        particles_per_batch(lumels, std::uint32_t(options.views.batch)));
}

StochasticOptions GlossyIllumination::phase_options() const
{
    return {.seed = options_.seed, .views = options_.views, .rule = options_.rule};
}

void GlossyIllumination::begin_phases(const NearField& near, std::span<const glm::vec3> known,
                                      std::span<const glm::vec3> first_emission)
{
    std::vector<glm::vec3> emission = emission_of(*lumels_);
    add_light(emission, first_emission);
    phases_.emplace(
        *device_, *world_, matte(*lumels_), near, phase_options(),
        first_emission.empty() ? known : std::span<const glm::vec3>{},
        [this](gpu::Pacer& pacer, const Iteration& iteration, std::uint32_t emission_shots) {
            phase_particles_->add(pacer, iteration, emission_shots);
        });
    batch_ = phases_->batch();
    phase_particles_.emplace(*device_, *particles_, std::move(emission), known,
                             particles_per_batch(count_, batch_), batch_, options_.seed);
}

/// The mean of the frame before is the guess that shooters and particles start from.
void GlossyIllumination::go_on_in_phases(const std::vector<glm::vec3>& mean, float kept)
{
    std::vector<glm::vec3> source = mean;
    for (std::size_t i = 0; i < source.size(); ++i)
        source[i] *= lumels_->gloss[i].diffuse;
    phases_->start_from(source);
    kept_ = mean;
    kept_weight_ = kept;
}

/// H of the phases, averaged with that of the frame before.
std::vector<glm::vec3> GlossyIllumination::mean_of_phases()
{
    std::vector<glm::vec3> mean = phases_->irradiance();
    const float all = kept_weight_ + float(state_.iterations);
    if (!(kept_weight_ > 0.0f))
        return mean;
    for (std::size_t i = 0; i < mean.size(); ++i)
        mean[i] = glm::mix(mean[i], kept_[i], kept_weight_ / all);
    return mean;
}

/// The mean becomes the light that shooters send next, and the average so far.
void GlossyIllumination::leave_phases()
{
    if (!phases_)
        return;
    const std::vector<glm::vec3> exitance = mean_exitance();
    std::vector<glm::vec3> halves = mean_of_phases();
    for (glm::vec3& h : halves)
        h *= 0.5f;
    halves.insert(halves.end(), halves.begin(), halves.begin() + std::ptrdiff_t(count_));
    times_of_phases_ = phases_->times();
    longest_of_phases_ = phases_->longest_submission();
    phases_.reset();
    phase_particles_.reset();
    views_.emplace(*device_, *world_, options_.views.projection,
                   std::uint32_t(options_.views.hemicube), batch_);
    exitance_.upload(exitance);
    diffuse_.upload(exitance);
    sums_.upload(halves);
    batches_ = {0.5f, 0.5f};
    goes_on_ = true;
    draw_in_proportion_to(exitance_, 0.0f);
    pacer_.finish();
}

const gpu::StageTimes& GlossyIllumination::times() const
{
    if (phases_)
        return phases_->times();
    times_ = pacer_.times();
    for (const auto& [stage, ms] : times_of_phases_)
        times_[stage] += ms;
    return times_;
}

double GlossyIllumination::longest_submission() const
{
    return std::max(
        {pacer_.longest_ms(), longest_of_phases_, phases_ ? phases_->longest_submission() : 0.0});
}

EnergyBalance GlossyIllumination::energy()
{
    const std::vector<glm::vec3> arriving = irradiance();
    if (!particles_)
        return {emitted_power_, double(figures_.now().column[0].w)};
    double absorbed = 0.0;
    for (std::size_t i = 0; i < arriving.size(); ++i)
        absorbed += double(lumels_->lumels[i].area) *
                    luminance(arriving[i] * (1.0f - lumels_->gloss[i].diffuse));
    // In phases, lobes' power from E is that of the solution's particles; else it is traced here.
    std::vector<glm::vec3> exitance(count_, glm::vec3(0.0f));
    if (phases_)
        absorbed -= phase_particles_->emission_lobe_power();
    else
        exitance = emission_.download();
    for (std::size_t i = 0; i < exitance.size(); ++i)
        exitance[i] += lumels_->gloss[i].diffuse * arriving[i];
    const std::size_t particles = kParticlesOfBalance * count_;
    absorbed -= particles_->carry(exitance, {}, particles, options_.seed).lobe_power;
    return {emitted_power_, absorbed};
}

}  // namespace lumel
