#pragma once
// The Vulkan C API through volk, which finds the loader at run time; nothing is linked.

#include <volk.h>
#include <vulkan/vulkan.h>

#include "base/core/error.h"

namespace lumel::gpu {

/// Throws Error{device} unless `result` is success. The message names the call and, for a lost
/// device or lack of memory, the remedy.
void check(VkResult result, const char* call);

}  // namespace lumel::gpu
