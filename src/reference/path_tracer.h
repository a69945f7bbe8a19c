#pragma once
// Paths that look for light from a point on, by next-event estimation and multiple importance
// sampling.

#include <optional>

#include <glm/glm.hpp>

#include "rays/ray_scene.h"
#include "reference/brdf.h"
#include "reference/emitters.h"
#include "reference/samples.h"
#include "reference/surfaces.h"

namespace lumel {

/// Where a path stands, lifted off the surface, on the side it may look to.
struct Stand {
    glm::vec3 position;   ///< [m] world
    glm::vec3 geometric;  ///< unit normal of the triangle
    Brdf brdf;            ///< with the shading normal, which cosines are taken with
};

/// Dimension pair of `PathSamples` that is free for where a path starts.
inline constexpr std::uint32_t kStartPair = 0;

/// Safe to use from many threads at once.
class PathTracer {
public:
    /// `scene` and `rays` must outlive this, unmoved. Gloss counts if the scene was read with it.
    PathTracer(const Scene& scene, const RayScene& rays, int max_bounces);

    /// One estimate of π × the radiance [lm/m²] that a point reflects towards where its BRDF looks.
    glm::vec3 reflected(Stand stand, const PathSamples& samples) const;

    /// One estimate of the radiance [cd/m²] along a unit direction; empty where nothing is.
    std::optional<glm::vec3> radiance(const glm::vec3& origin, const glm::vec3& direction,
                                      const PathSamples& samples) const;

    /// How far starts are lifted off their surface [m].
    float lift() const { return lift_; }

private:
    glm::vec3 direct(const Stand& stand, const glm::vec2& at, std::uint32_t seed) const;
    Stand land(const glm::vec3& origin, const glm::vec3& direction, float distance,
               const Shading& shading) const;

    const RayScene& rays_;
    Surfaces surfaces_;
    Emitters emitters_;
    int max_bounces_;
    float lift_;
};

}  // namespace lumel
