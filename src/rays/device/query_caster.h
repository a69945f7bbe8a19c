#pragma once
// Ray tracing by GPU ray queries (VK_KHR_ray_query).

#include <memory>

#include "gpu/device.h"
#include "rays/cast/ray_caster.h"

namespace lumel {

/// Builds a BVH over the triangles on the GPU. Both arguments must outlive the caster; no other
/// thread may use the device while rays are traced. Throws Error{device} if the device lacks ray
/// queries (Device::can_query_rays) or memory.
std::unique_ptr<RayCaster> cast_by_queries(const gpu::Device& device, const RayScene& rays);

}  // namespace lumel
