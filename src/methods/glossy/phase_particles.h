#pragma once
// Light of lobes for an iteration in phases, by particles traced on the CPU while the GPU works.

#include <array>
#include <future>
#include <span>
#include <vector>

#include "gpu/pacer.h"
#include "methods/glossy/lobe_particles.h"
#include "methods/glossy/phase_particles.add.comp.h"
#include "solve/shooting/iteration.h"

namespace lumel {

/// Adds the light of lobes to the sums of each batch. Particles for the next batch are traced while
/// the device works on this one; only where a phase begins, the CPU waits for its source.
class PhaseParticles {
public:
    /// particles: must outlive this. emission: [N] [lm/m²] sent by particles. known: [N] [lx] light
    /// of sky and lamps, or empty; see LobeParticles::carry. count: of particles per batch. batch:
    /// shooters per batch.
    PhaseParticles(const gpu::Device& device, const LobeParticles& particles,
                   std::vector<glm::vec3> emission, std::span<const glm::vec3> known,
                   std::size_t count, std::uint32_t batch, std::uint32_t seed);
    static std::uint64_t device_bytes(std::size_t lumel_count);

    /// Call between Iteration::begin_batch() and finish_batch(). emission_shots: of this batch's
    /// shooters.
    void add(gpu::Pacer& pacer, const Iteration& iteration, std::uint32_t emission_shots);

    /// Power of E that lobes reflect, mean of all batches [lm].
    double emission_lobe_power() const;

private:
    static constexpr std::size_t kSlots = 2;  ///< batches in flight

    struct Light {
        LobeParticles::Carried emission, source;  ///< of E and of X
    };

    /// Staging memory of a batch.
    struct Slot {
        Slot(const gpu::Device& device, std::size_t count);
        gpu::Array<glm::vec3> emission, source;  ///< [N] [lx]
        std::uint64_t ticket = 0;
    };

    void start(std::uint32_t emission_shots, std::uint32_t number);

    const LobeParticles* particles_;
    std::vector<glm::vec3> emission_, known_;
    std::size_t lumels_;  ///< N
    std::size_t count_;
    std::uint32_t batch_, seed_;
    gpu::Kernel<shaders::PhaseParticlesAdd> add_;
    std::array<Slot, kSlots> slots_;
    std::vector<glm::vec3> source_;  ///< X [N]; empty: 0
    std::uint32_t phase_ = 0, number_ = 0;
    std::array<double, 2> lobe_power_{}, emission_shots_{};  ///< sums, per half
    std::future<Light> found_;                               ///< last member: its destructor waits
};

}  // namespace lumel
