#pragma once
// Paths that look for light from a point on, by next-event estimation and multiple importance
// sampling.

#include <optional>

#include <glm/glm.hpp>

#include "rays/cast/ray_scene.h"
#include "rays/paths/samples.h"
#include "rays/paths/surfaces.h"
#include "scene/values/parts.h"
#include "truth/lights.h"
#include "truth/path_vertex.h"

namespace lumel {

/// Safe to use from many threads at once.
class PathTracer {
public:
    /// `scene` and `rays` must outlive this, unmoved. Gloss counts if the scene was read with it.
    /// `parts`: which light arrives at the points of `reflected`.
    PathTracer(const Scene& scene, const RayScene& rays, int max_bounces, Parts parts = Parts::all);

    /// One estimate of π × the radiance [lm/m²] that a point reflects towards where its BRDF looks.
    glm::vec3 reflected(PathVertex vertex, const PathSamples& samples) const;

    /// One estimate of the radiance [cd/m²] along a unit direction; that of the sky where nothing
    /// is, empty without one. Lamps are not seen.
    std::optional<glm::vec3> radiance(const glm::vec3& origin, const glm::vec3& direction,
                                      const PathSamples& samples) const;

    /// How far starts are lifted off their surface [m].
    float ray_offset() const { return ray_offset_; }

private:
    PathVertex land(const glm::vec3& origin, const glm::vec3& direction, float distance,
                    const Shading& shading) const;

    const RayScene& rays_;
    Surfaces surfaces_;
    float ray_offset_;
    Lights lights_;
    int first_bounce_;  ///< whose light counts
    int last_bounce_;
};

}  // namespace lumel
