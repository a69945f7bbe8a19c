#pragma once
// Shadow rays, queued singly and traced in batches.

#include <cmath>
#include <cstdint>
#include <vector>

#include "lights/sources.h"
#include "rays/cast/ray_caster.h"

namespace lumel {

/// Segment from a point to just before a source sample.
inline RaySpan ray_towards(const SourceSample& sample, const RayOrigin& start, std::uint32_t seed)
{
    if (std::isinf(sample.distance))
        return ray_out(start.position, sample.direction, seed);
    return {start.position, 0.0f, sample.direction, sample.distance - sample.ray_offset, seed};
}

/// Transmittance of that segment, 0…1; no ray is traced to a sample of no light.
inline glm::vec3 transmittance_to(const RayScene& rays, const SourceSample& sample,
                                  const RayOrigin& start, std::uint32_t seed)
{
    return sample.irradiance == glm::vec3(0.0f)
               ? glm::vec3(0.0f)
               : rays.transmittance(ray_towards(sample, start, seed));
}

class ShadowRays {
public:
    std::uint32_t size() const { return std::uint32_t(samples_.size()); }

    /// Queues the shadow ray of a sample. Samples of no light are not traced.
    void add(const SourceSample& sample, const RaySpan& ray)
    {
        const bool dark = sample.irradiance == glm::vec3(0.0f);
        ray_of_.push_back(dark ? kNoRay : std::uint32_t(rays_.size()));
        samples_.push_back(sample);
        if (!dark)
            rays_.push_back(ray);
    }
    void cast(const RayCaster& caster)
    {
        transmittance_.resize(rays_.size());
        caster.transmittance(rays_, transmittance_);
    }
    void clear()
    {
        samples_.clear();
        ray_of_.clear();
        rays_.clear();
    }

    const SourceSample& sample(std::size_t look) const { return samples_[look]; }
    /// Transmittance of shadow ray `look`, 0…1. Call cast() first.
    glm::vec3 transmittance(std::size_t look) const
    {
        return ray_of_[look] == kNoRay ? glm::vec3(0.0f) : transmittance_[ray_of_[look]];
    }

private:
    static constexpr std::uint32_t kNoRay = ~0u;
    std::vector<SourceSample> samples_;  ///< [looks]
    std::vector<std::uint32_t> ray_of_;  ///< [looks]
    std::vector<RaySpan> rays_;
    std::vector<glm::vec3> transmittance_;  ///< [rays]
};

}  // namespace lumel
