#pragma once
// Rays of lumels to the sky.

#include <cstdint>

#include "atlas/cells/ray_origins.h"
#include "atlas/prepare/solve_scene.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Thread-safe.
class SkyRays {
public:
    /// count: rays of a lumel. scene must outlive this.
    SkyRays(const SolveScene& scene, std::uint32_t count, std::uint32_t seed);

    /// Calls visit(direction, light) for each ray of a lumel that leaves the scene; light:
    /// irradiance [lx] by a luminance of 1 cd/m² from there.
    template <class Visit>
    void visit(std::size_t lumel, const Visit& visit) const
    {
        const std::uint32_t stream = stream_of(lumel);
        for (std::uint32_t k = 0; k < count_; ++k) {
            glm::vec3 direction;
            const glm::vec3 light = send(lumel, PathSamples(stream, k), direction);
            if (light != glm::vec3(0.0f))
                visit(direction, light);
        }
    }

    /// Irradiance [lx] by a sun of 1 lx on a plane that faces it, the mean of `count` rays. number:
    /// selects their random numbers.
    glm::vec3 sun(std::size_t lumel, const glm::vec3& to_sun, std::uint32_t number,
                  std::uint32_t count) const;

private:
    std::uint32_t stream_of(std::size_t lumel) const;
    glm::vec3 send(std::size_t lumel, const PathSamples& samples, glm::vec3& direction) const;

    const SolveScene& scene_;
    WorldLumels world_;
    RayOrigins starts_;
    std::uint32_t count_, seed_;
};

}  // namespace lumel
