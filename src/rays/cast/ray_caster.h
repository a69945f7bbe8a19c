#pragma once
// Closest-hit and transmittance queries for ray batches, on the CPU or the GPU.

#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "rays/cast/ray_scene.h"

namespace lumel {

/// Traces batches of rays. Thread-safe; a result depends only on its ray. All casters agree up to
/// rounding: equal seeds pass equal surfaces.
class RayCaster {
public:
    virtual ~RayCaster() = default;

    /// hits [rays]: closest hit of each ray. Without a hit the distance is kNothing and only the
    /// tint is valid.
    virtual void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const = 0;
    static constexpr float kNothing = std::numeric_limits<float>::infinity();

    /// transmittance [rays]: 0 if the ray is occluded, else the product of the tints.
    virtual void transmittance(std::span<const RaySpan> rays,
                               std::span<glm::vec3> transmittance) const = 0;

    /// Recommended number of rays per batch.
    virtual std::size_t batch() const = 0;

    /// "host", "query" or "tree", for reports.
    virtual const char* name() const = 0;
};

/// Traces rays by Embree. `rays` must outlive the result.
std::unique_ptr<RayCaster> cast_on_host(const RayScene& rays);

}  // namespace lumel
