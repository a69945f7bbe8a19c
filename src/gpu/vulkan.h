#pragma once
// The Vulkan C API through volk, which finds the loader at run time; nothing is linked.

#include <string>

#include <volk.h>
#include <vulkan/vulkan.h>

#include "base/core/error.h"

namespace lumel::gpu {

/// Error{device} where less work, or none on the device, would do: too little GPU memory, or an
/// array longer than the device allows.
class OutOfMemory : public Error {
public:
    OutOfMemory(const std::string& where, const std::string& what)
        : Error(ErrorKind::device, where, what)
    {
    }
};

/// Throws Error{device} unless `result` is success, for lack of memory OutOfMemory. The message
/// names the call and, for these and a lost device, the remedy.
void check(VkResult result, const char* call);

}  // namespace lumel::gpu
