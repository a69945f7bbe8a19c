#pragma once
// Who is met first, asked for many rays at once. Answers come from the host or from a device.

#include <cstddef>
#include <limits>
#include <memory>
#include <span>

#include "rays/cast/ray_scene.h"

namespace lumel {

/// Answers for batches of rays. Safe to ask from many threads at once; an answer depends on the ray
/// alone. Casters agree but for rounding: the same surfaces let the same seeds pass.
class RayCaster {
public:
    virtual ~RayCaster() = default;

    /// hits [rays]: what each ray meets first. Its distance is kNothing where it meets nothing; its
    /// tint counts then too.
    virtual void closest(std::span<const RaySpan> rays, std::span<RayHit> hits) const = 0;
    static constexpr float kNothing = std::numeric_limits<float>::infinity();

    /// transmittance [rays]: the part of light that gets along each ray: 0 if something is in
    /// between, else the product of the tints.
    virtual void transmittance(std::span<const RaySpan> rays,
                               std::span<glm::vec3> transmittance) const = 0;

    /// Rays of a batch that make good use of it.
    virtual std::size_t batch() const = 0;

    /// "host" or "query", for reports.
    virtual const char* name() const = 0;
};

/// Rays through Embree. The rays' scene must outlive it.
std::unique_ptr<RayCaster> cast_on_host(const RayScene& rays);

}  // namespace lumel
