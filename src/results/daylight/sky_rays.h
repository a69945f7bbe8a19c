#pragma once
// Rays of lumels to the sky.

#include <cstdint>

#include "atlas/cells/ray_origins.h"
#include "atlas/prepare/solve_scene.h"
#include "base/core/pi.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Thread-safe.
class SkyRays {
public:
    /// The scene must outlive this.
    explicit SkyRays(const SolveScene& scene);
    SkyRays(const SkyRays&) = delete;  // the origins point into it
    SkyRays& operator=(const SkyRays&) = delete;

    /// Sends `count` rays from a lumel, and calls visit(direction, light) for each that leaves the
    /// scene; light: irradiance [lx] by a luminance of 1 cd/m² from there.
    template <class Visit>
    void visit(std::size_t lumel, std::uint32_t count, std::uint32_t seed, const Visit& visit) const
    {
        const std::uint32_t stream = stream_of(lumel, seed);
        for (std::uint32_t k = 0; k < count; ++k) {
            glm::vec3 direction;
            const glm::vec3 light = send(lumel, PathSamples(stream, k), direction);
            if (light != glm::vec3(0.0f))
                visit(direction, kPi / float(count) * light);
        }
    }

    /// Irradiance [lx] by a sun of 1 lx on a plane that faces it, the mean of `count` rays. number:
    /// selects their random numbers.
    glm::vec3 sun(std::size_t lumel, const glm::vec3& to_sun, std::uint32_t number,
                  std::uint32_t count, std::uint32_t seed) const;

private:
    std::uint32_t stream_of(std::size_t lumel, std::uint32_t seed) const;
    /// Transmittance of glass along a ray of density cosθ / π; 0 if it is stopped.
    glm::vec3 send(std::size_t lumel, const PathSamples& samples, glm::vec3& direction) const;

    const SolveScene& scene_;
    WorldLumels world_;
    RayOrigins starts_;
};

}  // namespace lumel
