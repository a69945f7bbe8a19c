#pragma once
// Ratio estimator for the light of one source.

#include <cstdint>

#include <glm/glm.hpp>

#include "base/core/luminance.h"
#include "lights/sources.h"

namespace lumel {

/// Exact unoccluded irradiance × mean transmittance, weighted by each ray's contribution f, if the
/// exact value is known:
///
///     D = ⟨open⟩ · Σ V f / Σ f,        else  D = ⟨V f⟩.
///
/// Lumels that see all of a source, or nothing of it, then have no noise.
struct SourceEstimate {
    glm::vec3 open{0.0f};    ///< Σ of exact unoccluded irradiance [lx]
    glm::vec3 passed{0.0f};  ///< Σ V f [lx]
    float offered = 0.0f;    ///< Σ f by luminance
    glm::vec3 seen{0.0f};    ///< Σ V f by luminance of f
    std::uint32_t rays = 0, free = 0, hidden = 0;
    bool exact = true;

    void add(const SourceSample& sample, const glm::vec3& transmittance)
    {
        const float offer = float(luminance(sample.irradiance));
        ++rays;
        if (sample.open)
            open += *sample.open;
        else
            exact = false;
        passed += transmittance * sample.irradiance;
        offered += offer;
        seen += transmittance * offer;
        if (offer > 0.0f)
            ++(transmittance == glm::vec3(0.0f) ? hidden : free);
    }
    glm::vec3 light() const
    {
        if (rays == 0)
            return glm::vec3(0.0f);
        if (!exact)
            return passed / float(rays);
        return offered > 0.0f ? open / float(rays) * (seen / offered) : glm::vec3(0.0f);
    }
};

}  // namespace lumel
