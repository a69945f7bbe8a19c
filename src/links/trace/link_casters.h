#pragma once
// Ray tracing backends of the link engine.

#include "gpu/device.h"
#include "links/direct/link_work.h"
#include "links/trace/links_options.h"

namespace lumel {

/// The backend of the options; `rays` must outlive it. Throws Error{device} if the device lacks it.
LinkWork::Casters casters_for(const gpu::Device& device, const RayScene& rays, Rays wanted);

}  // namespace lumel
