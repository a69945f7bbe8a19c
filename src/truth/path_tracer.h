#pragma once
// Path tracing by next-event estimation and multiple importance sampling.

#include <optional>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "rays/paths/samples.h"
#include "rays/paths/surfaces.h"
#include "scene/values/parts.h"
#include "truth/lights.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Thread-safe.
class PathTracer {
public:
    /// `scene` and `rays` must outlive this, unmoved. Uses gloss if the scene was read with it.
    /// parts: light that arrives at the points of `reflected`.
    PathTracer(const Scene& scene, const RayScene& rays, int max_bounces, Parts parts = Parts::all);

    /// One estimate of π × radiance [lm/m²] that a point reflects toward the direction of its BRDF.
    glm::vec3 reflected(PathVertex vertex, const PathSamples& samples) const;

    /// One estimate of the radiance along a unit direction [cd/m²], the sky's if nothing is hit;
    /// empty without a sky. Lamps are invisible.
    std::optional<glm::vec3> radiance(const glm::vec3& origin, const glm::vec3& direction,
                                      const PathSamples& samples) const;

private:
    static PathVertex land(const glm::vec3& origin, const glm::vec3& direction, const RayHit& hit,
                           const Shading& shading);

    const RayScene& rays_;
    Surfaces surfaces_;
    Lights lights_;
    int first_bounce_;  ///< first bounce whose light counts
    int last_bounce_;
};

}  // namespace lumel
