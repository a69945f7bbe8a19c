#pragma once
// Ray tracing backends of the link engine.

#include <cstdint>
#include <string>

#include "gpu/device.h"
#include "links/direct/link_work.h"
#include "links/trace/links_options.h"

namespace lumel {

/// The backend of the options; `rays` must outlive it. device: null if there is none. Throws
/// Error{device} if the device lacks the backend.
LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted);

/// Device memory of that backend [bytes]: 0 for the host's. device: its type, as gpu::DeviceInfo
/// has it.
std::uint64_t caster_bytes(const std::string& device, const RayScene& rays, Rays wanted);

}  // namespace lumel
