#pragma once
// The Vulkan C API through volk: nothing is linked, the loader is found at run time.

#include <volk.h>
#include <vulkan/vulkan.h>

#include "base/core/error.h"

namespace lumel::gpu {

/// Throws Error{device} unless `result` is success; names the call and, for a lost device or
/// missing memory, the remedy.
void check(VkResult result, const char* call);

}  // namespace lumel::gpu
