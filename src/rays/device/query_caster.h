#pragma once
// Rays through the ray queries of a device (VK_KHR_ray_query).

#include <memory>

#include "gpu/device.h"
#include "rays/cast/ray_caster.h"

namespace lumel {

/// Builds a tree over the triangles on the device. Both must outlive the caster; while rays are
/// cast no other thread may use the device. Throws Error{device} where the device has no ray
/// queries (Device::can_query_rays), or too little memory.
std::unique_ptr<RayCaster> cast_by_queries(const gpu::Device& device, const RayScene& rays);

}  // namespace lumel
