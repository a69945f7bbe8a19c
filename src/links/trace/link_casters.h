#pragma once
// Ray tracing backends of the link engine.

#include <cstdint>

#include "gpu/device.h"
#include "links/direct/link_work.h"
#include "links/trace/links_options.h"

namespace lumel {

/// The backend that Rays::automatic selects: never Rays::tree, with which bakes on an H100 beside
/// 16 cores took longer than on the host (bench/performance.md). device: without a type if there is
/// none.
Rays automatic_rays(const gpu::DeviceInfo& device);

/// The backend of the options; `rays` must outlive it. device: null if there is none. Throws
/// Error{device} if the device lacks the backend.
LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted);

/// Device memory of that backend [bytes]: 0 for the host's.
std::uint64_t caster_bytes(const gpu::DeviceInfo& device, const RayScene& rays, Rays wanted);

}  // namespace lumel
