#pragma once
// Rays that share directions, cast by drawing: for devices without ray queries.
//
//   [TSO11] Y. Tokuyoshi, T. Sekine, S. Ogaki. Fast Global Illumination Baking via Ray-Bundles.
//   2011.

#include <cstdint>
#include <memory>
#include <span>

#include <glm/glm.hpp>

#include "gpu/device.h"
#include "rays/cast/ray_caster.h"

namespace lumel {

/// Rays in bundles, each of one direction.
struct RayBundles {
    std::span<const glm::vec3> directions;  ///< unit
    std::span<const std::uint32_t> along;   ///< [rays] index into directions
    std::span<const RaySpan> rays;          ///< each has its direction, too
};

/// Draws the scene along every direction that rays have, so as to list the triangles that touch
/// each pixel; a ray is tested against those of its pixel. So it meets what it meets on the host,
/// but for rounding. A drawing costs the same for one ray and for a million.
class BundleCaster {
public:
    /// Both must outlive it; while rays are cast no other thread may use the device. Throws
    /// Error{device} where fragments cannot write lists (Device::can_list_fragments), or where
    /// memory is too small.
    BundleCaster(const gpu::Device& device, const RayScene& rays);
    ~BundleCaster();

    /// hits [rays]: what each ray meets first, as RayCaster has it. Rays that pass glass, veils or
    /// cut-outs go on on the host. For one thread at a time.
    void closest(const RayBundles& bundles, std::span<RayHit> hits) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace lumel
