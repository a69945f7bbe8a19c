#pragma once
// What does not fit into memory.

#include <cstdint>
#include <string>

#include "gpu/device.h"

namespace lumel {

/// A sentence if work needs more graphics memory than the device has; empty if it fits. host_bytes:
/// what the machine itself has left, which is what a processor that stands in for a device uses; 0:
/// not known.
std::string shortage(std::uint64_t needed_bytes, const gpu::DeviceInfo& device,
                     std::uint64_t host_bytes);

}  // namespace lumel
