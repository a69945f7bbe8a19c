// The light of lobes is a second transport operator P beside that of the shooters, T:
//
//     H = (T + P)(E + ρ_d H),
//
// unbiased in every batch. It joins the sums of both parts of the light with the weight of the
// batch's shots (iteration.cpp):
//
//     direct += K_E P* E,     indirect += K_X P* X,     X = ρ_d H of the phase.

#include "methods/glossy/phase_particles.h"

#include <algorithm>
#include <cstring>

namespace lumel {
namespace {

/// The random numbers of a batch: those of E and those of X.
constexpr std::uint32_t kStreams = 2;

}  // namespace

PhaseParticles::Slot::Slot(const gpu::Device& device, std::size_t count)
    : emission(device, count, gpu::Buffer::Place::host, "phase_particles.emission"),
      source(device, count, gpu::Buffer::Place::host, "phase_particles.source")
{
}

PhaseParticles::PhaseParticles(const gpu::Device& device, const LobeParticles& particles,
                               std::vector<glm::vec3> emission, std::span<const glm::vec3> known,
                               std::size_t count, std::uint32_t batch, std::uint32_t seed)
    : particles_(&particles),
      emission_(std::move(emission)),
      known_(known.begin(), known.end()),
      lumels_(emission_.size()),
      count_(count),
      batch_(batch),
      seed_(seed),
      add_(device),
      slots_{Slot(device, lumels_), Slot(device, lumels_)}
{
}

std::uint64_t PhaseParticles::device_bytes(std::size_t lumel_count)
{
    constexpr std::uint64_t kOfSlot = 2;  // number of arrays
    return kOfSlot * kSlots * lumel_count * sizeof(glm::vec3);
}

/// Particles of E and X are about in proportion to the shooters of both. They are for the next
/// batch, which can have a shooter of either where this one has none.
void PhaseParticles::start(std::uint32_t emission_shots, std::uint32_t number)
{
    const std::size_t from_emission = count_ * std::max(emission_shots, 1u) / batch_ + 1;
    const std::size_t from_source = count_ * std::max(batch_ - emission_shots, 1u) / batch_ + 1;
    found_ = std::async(std::launch::async, [this, from_emission, from_source, number] {
        const auto stream = [&](std::uint32_t of) {
            return PathSamples::hash(seed_, kStreams * number + of);
        };
        Light light;
        light.emission = particles_->carry(emission_, known_, from_emission, stream(0));
        if (!source_.empty())
            light.source = particles_->carry(source_, {}, from_source, stream(1));
        return light;
    });
}

void PhaseParticles::add(gpu::Pacer& pacer, const Iteration& iteration,
                         std::uint32_t emission_shots)
{
    if (iteration.phase() != phase_) {
        // Particles traced ahead left from the source of the former phase.
        if (found_.valid())
            found_.wait();
        pacer.finish();
        source_ = iteration.source().download();
        phase_ = iteration.phase();
        start(emission_shots, number_);
    }
    if (!found_.valid())
        start(emission_shots, number_);
    const Light light = found_.get();
    start(emission_shots, ++number_);

    lobe_power_[iteration.half()] += double(emission_shots) * light.emission.lobe_power;
    emission_shots_[iteration.half()] += double(emission_shots);
    Slot& slot = slots_[number_ % kSlots];
    pacer.wait(slot.ticket);
    const auto stage = [](const std::vector<glm::vec3>& from, const gpu::Array<glm::vec3>& to) {
        if (!from.empty())
            std::memcpy(to.buffer().mapped(), from.data(), from.size() * sizeof(glm::vec3));
    };
    stage(light.emission.irradiance, slot.emission);
    stage(light.source.irradiance, slot.source);
    pacer.dispatch("carried", add_,
                   {.emission = slot.emission,
                    .source = slot.source,
                    .direct = iteration.direct(),
                    .indirect = iteration.indirect()},
                   PhaseParticlesParams{
                       std::uint32_t(lumels_), iteration.half(), float(emission_shots),
                       light.source.irradiance.empty() ? 0.0f : float(batch_ - emission_shots)},
                   lumels_);
    slot.ticket = pacer.flush();
}

/// Mean of both halves, as Iteration averages them.
double PhaseParticles::emission_lobe_power() const
{
    double sum = 0.0, halves = 0.0;
    for (std::size_t h = 0; h < emission_shots_.size(); ++h)
        if (emission_shots_[h] > 0.0) {
            sum += lobe_power_[h] / emission_shots_[h];
            halves += 1.0;
        }
    return halves > 0.0 ? sum / halves : 0.0;
}

}  // namespace lumel
