#pragma once
// All light sources of a scene for a path tracer: sampled, or hit by chance.

#include <optional>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "rays/paths/surfaces.h"
#include "scene/values/sky.h"
#include "truth/bounce_samples.h"
#include "truth/emitters.h"
#include "truth/lamps.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Emissive surfaces, the sky and lamps. Thread-safe.
class Lights {
public:
    /// All arguments must outlive this, unmoved.
    Lights(const Scene& scene, const RayScene& rays, const Surfaces& surfaces);

    /// One estimate of ∫ s L cosθ dω [lm/m²] by shadow rays: lamps in full, emitters and the sky
    /// with their weight. s is π f_r / ρ, 1 for a diffuse surface.
    glm::vec3 sought(const PathVertex& vertex, const BounceSamples& samples) const
    {
        glm::vec3 sought(0.0f);
        if (!emitters_.empty())
            sought += from_emitter(vertex, samples);
        if (sky_sampler_)
            sought += from_sky(vertex, samples);
        if (lamps_.count() > 0)
            sought += from_lamps(vertex, samples);
        return sought;
    }

    /// The weighted remainder: radiance [cd/m²] of the surface that a direction of this `density`
    /// per solid angle hits, or of the sky.
    glm::vec3 met(const RayHit& hit, const Shading& shading, const glm::vec3& direction,
                  float density) const;
    glm::vec3 met_sky(const glm::vec3& direction, float density) const;

    /// Radiance of the sky [cd/m²]; empty without one.
    std::optional<glm::vec3> background(const glm::vec3& direction) const;

private:
    glm::vec3 from_emitter(const PathVertex& vertex, const BounceSamples& samples) const;
    glm::vec3 from_sky(const PathVertex& vertex, const BounceSamples& samples) const;
    glm::vec3 from_lamps(const PathVertex& vertex, const BounceSamples& samples) const;

    const RayScene& rays_;
    const Surfaces& surfaces_;
    const Sky& sky_;
    Emitters emitters_;
    Lamps lamps_;
    std::optional<SkySampler> sky_sampler_;  ///< empty: the sky is hit by chance only
};

}  // namespace lumel
