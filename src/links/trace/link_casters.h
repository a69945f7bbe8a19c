#pragma once
// Ray tracing backends of the link engine.

#include "gpu/device.h"
#include "links/direct/link_work.h"
#include "links/trace/links_options.h"

namespace lumel {

/// The backend of the options; `rays` must outlive it. device: null if there is none. Throws
/// Error{device} if the device lacks the backend.
LinkWork::Casters casters_for(const gpu::Device* device, const RayScene& rays, Rays wanted);

}  // namespace lumel
