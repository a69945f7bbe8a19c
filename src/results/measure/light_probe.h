#pragma once
// The light that arrives at a point in the air from all around, as spherical harmonics.

#include <array>

#include "base/core/spherical_harmonics.h"
#include "results/measure/arriving_light.h"

namespace lumel {

struct LightProbeOptions {
    /// Rays over the sphere, and as many towards sources, at least. There are up to 64 times as
    /// many where ProbeLight::noise is above 0.5 % of band 0.
    std::uint32_t samples = 4096;
    std::uint32_t seed = 1;
};

struct ProbeLight {
    /// c_lm = ∫ L Y_lm dω at l² + l + m, linear RGB [cd/m²].
    std::array<glm::vec3, kMaxCoefficients> coefficients{};
    /// Standard error of the luminance of the noisiest coefficient, of the rays alone [cd/m²].
    double noise = 0.0;
    bool inside = false;  ///< most of what it sees tells of the inside of something
};

/// Safe to use from many threads at once.
class LightProbe {
public:
    /// As of ArrivingLight.
    LightProbe(const Scene& scene, const RayScene& rays, const Atlas& atlas, const Lumels& lumels,
               std::span<const glm::vec3> irradiance, const LightProbeOptions& options);

    /// number: of the probe; others have other random numbers.
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
