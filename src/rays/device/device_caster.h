#pragma once
// Ray tracing on the GPU: by ray queries (VK_KHR_ray_query), or by a tree that a compute shader
// walks.

#include <cstdint>
#include <memory>

#include "gpu/device.h"
#include "rays/cast/ray_caster.h"

namespace lumel {

/// Builds a BVH over the triangles on the GPU. Both arguments must outlive the caster; no other
/// thread may use the device while rays are traced. Throws Error{device} if the device lacks ray
/// queries (Device::can_query_rays) or memory.
std::unique_ptr<RayCaster> cast_by_queries(const gpu::Device& device, const RayScene& rays);

/// Casts rays on any device, by a BVH that the host builds (build_flat_tree). Throws Error{device}
/// if the device or the host lacks memory, or the scene exceeds the arrays of the device.
std::unique_ptr<RayCaster> cast_by_tree(const gpu::Device& device, const RayScene& rays);

/// Memory of either [bytes], arrays that the device shares with the host included, if all cores
/// cast rays.
std::uint64_t device_rays_bytes(const RayScene& rays);

}  // namespace lumel
