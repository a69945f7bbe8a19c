#pragma once
// Light carried by particles, traced on the CPU while the GPU works.

#include <array>
#include <future>
#include <span>
#include <vector>

#include "gpu/pacer.h"
#include "methods/glossy/lobe_particles.h"

namespace lumel {

/// Particles for consecutive iterations on the device. Those of an iteration start from the
/// light of a fixed earlier one: CPU and GPU do not wait for each other if they are about equally
/// fast, and timing cannot change a result.
class CarriedLight {
public:
    /// particles: must outlive this; null: none. direct: see LobeParticles::carry. emission: [N]
    /// [lm/m²] sent by particles in addition to the exitance on the device, or empty.
    CarriedLight(const gpu::Device& device, const LobeParticles* particles,
                 std::span<const glm::vec3> direct, std::span<const glm::vec3> emission,
                 std::size_t lumel_count);
    static std::uint64_t device_bytes(std::size_t lumel_count);

    /// Records the upload of an iteration's light, and starts tracing that of the next. exitance:
    /// [N] on the device, see LobeParticles::carry. count: of particles. seed, number: unique for
    /// the iteration's particles.
    void begin(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance, std::size_t count,
               std::uint32_t seed, std::uint32_t number);
    /// Ends the iteration: starts the readback of its light.
    void end(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance);

    /// Makes the next iteration the first and discards pending work. Requires that the pacer has
    /// finished.
    void restart();

    const gpu::Array<glm::vec3>& irradiance() const { return irradiance_; }  ///< [N] [lx]
    const gpu::Array<glm::vec3>& reflected() const { return reflected_; }    ///< [N] [lm/m²]

private:
    static constexpr std::size_t kSlots = 2;  ///< iterations in flight

    /// Staging memory of an iteration.
    struct Slot {
        Slot(const gpu::Device& device, std::size_t count);
        gpu::Array<glm::vec3> irradiance, reflected, exitance;
        std::uint64_t ticket = 0;
    };

    void find(std::size_t count, std::uint32_t seed);

    const LobeParticles* particles_;
    std::vector<glm::vec3> direct_, emission_;
    std::size_t count_;  ///< N, 0 without particles
    std::array<Slot, kSlots> slots_;
    gpu::Array<glm::vec3> irradiance_, reflected_;
    std::uint64_t iteration_ = 0;
    std::vector<glm::vec3> exitance_;            ///< newest one read back
    std::vector<glm::vec3> leaving_;             ///< exitance that particles start from
    std::future<LobeParticles::Carried> found_;  ///< last member: its destructor waits
};

}  // namespace lumel
