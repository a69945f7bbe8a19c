#pragma once
// Incoming light at a point in the air, as spherical harmonics.

#include <array>

#include "base/core/spherical_harmonics.h"
#include "results/measure/arriving_light.h"

namespace lumel {

struct LightProbeOptions {
    /// Minimum rays over the sphere, and as many to sources; up to 64 times as many until
    /// ProbeLight::noise is below 0.5 % of band 0.
    std::uint32_t samples = 4096;
    std::uint32_t seed = 1;
};

struct ProbeLight {
    /// c_lm = ∫ L Y_lm dω at l² + l + m, linear RGB [cd/m²].
    std::array<glm::vec3, kMaxCoefficients> coefficients{};
    /// Standard error of the luminance of the noisiest coefficient, by the rays alone [cd/m²].
    double noise = 0.0;
    bool inside = false;  ///< true if it seems to be inside an object
};

/// Thread-safe.
class LightProbe {
public:
    /// As in ArrivingLight.
    LightProbe(const Scene& scene, const RayScene& rays, const Atlas& atlas, const Lumels& lumels,
               std::span<const glm::vec3> irradiance, const LightProbeOptions& options);

    /// number: of the probe; selects its random numbers.
    ProbeLight read(const glm::vec3& position, std::uint32_t number) const;

private:
    using Coefficients = std::array<glm::vec3, kMaxCoefficients>;

    // Rays `from` to `to`, in multiples of rays_of_set_.
    void add_rays(const glm::vec3& position, std::uint32_t stream, std::uint32_t from,
                  std::uint32_t to, std::uint32_t& backs, Coefficients& sums) const;
    void add_sources(const glm::vec3& position, const RayAllocation& shares, std::uint32_t stream,
                     std::uint32_t from, std::uint32_t to, Coefficients& sums) const;
    void add_sample(std::size_t source, const glm::vec3& position, const glm::vec2& at,
                    std::uint32_t seed, float weight, Coefficients& sums) const;

    ArrivingLight light_;
    std::uint32_t rays_of_set_, seed_;
};

}  // namespace lumel
