#pragma once
// Traces rays that share directions by rasterisation, on devices without ray queries.
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

/// Rays with shared directions.
struct RayBundles {
    std::span<const glm::vec3> directions;  ///< unit
    std::span<const std::uint32_t> along;   ///< [rays] index into directions
    std::span<const RaySpan> rays;          ///< direction as in `directions`
};

/// Rasterises the scene along each direction to list the triangles that touch each pixel, then
/// tests each ray against those of its pixel. Hits equal those on the CPU up to rounding. The
/// cost of a pass does not depend on the number of rays.
class BundleCaster {
public:
    /// Both must outlive this; no other thread may use the device during closest(). Throws
    /// Error{device} if fragments cannot write lists (Device::can_list_fragments) or memory is
    /// insufficient.
    BundleCaster(const gpu::Device& device, const RayScene& rays);
    ~BundleCaster();

    /// hits [rays]: closest hits, as in RayCaster. Rays that meet glass, blended surfaces or
    /// cut-outs are cast again by the CPU. Not thread-safe.
    void closest(const RayBundles& bundles, std::span<RayHit> hits) const;

private:
    struct Data;
    std::unique_ptr<Data> data_;
};

}  // namespace lumel
