#pragma once
// What particles carry, found on the host while the device goes on.

#include <array>
#include <future>
#include <span>
#include <vector>

#include "gpu/pacer.h"
#include "methods/glossy/lobe_particles.h"

namespace lumel {

/// Particles for each of a row of iterations on the device. Those of an iteration start from the
/// light of a fixed number of iterations before, so that host and device never wait for each other
/// where they are about as fast, and timing cannot change a result.
class CarriedLight {
public:
    /// particles: must outlive this; null: none are carried. direct: as LobeParticles::carry takes
    /// it. emission: [N] [lm/m²] that particles leave beside the exitance on the device, or empty.
    CarriedLight(const gpu::Device& device, const LobeParticles* particles,
                 std::span<const glm::vec3> direct, std::span<const glm::vec3> emission,
                 std::size_t lumel_count);
    static std::uint64_t device_bytes(std::size_t lumel_count);

    /// Records the way of an iteration's light to the device, and begins to find that of the next.
    /// exitance: [N] on the device, as LobeParticles::carry takes it. count: of particles.
    /// seed, number: of this iteration, whose particles differ from all others'.
    void begin(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance, std::size_t count,
               std::uint32_t seed, std::uint32_t number);
    /// Ends that iteration: starts its light on its way back.
    void end(gpu::Pacer& pacer, const gpu::Array<glm::vec3>& exitance);

    /// The next iteration is the first: what is on its way is forgotten. The pacer must have
    /// finished.
    void restart();

    const gpu::Array<glm::vec3>& irradiance() const { return irradiance_; }  ///< [N] [lx]
    const gpu::Array<glm::vec3>& reflected() const { return reflected_; }    ///< [N] [lm/m²]

private:
    static constexpr std::size_t kSlots = 2;  ///< iterations in flight

    /// Host memory that an iteration's copies read and write.
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
    std::vector<glm::vec3> exitance_;            ///< of the device, the newest that is here
    std::vector<glm::vec3> leaving_;             ///< that particles start from
    std::future<LobeParticles::Carried> found_;  ///< after all that it reads: it waits when it ends
};

}  // namespace lumel
