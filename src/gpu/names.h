#pragma once
// Names for RenderDoc, Nsight and validation messages. No effect if the instance lacks
// VK_EXT_debug_utils.

#include <string>

#include "gpu/device.h"

namespace lumel::gpu {

/// Sets the name that debuggers show for the object with a handle of that type.
void set_name(const Device& device, VkObjectType type, const void* handle, const std::string& name);

/// Begins a named region of a command buffer, up to the matching end_region().
void begin_region(const Device& device, VkCommandBuffer commands, const char* name);
void end_region(const Device& device, VkCommandBuffer commands);

/// The name of an array or an image: a given text, or the source line that creates it. As a default
/// argument it takes the caller's line.
class Name {
public:
    Name(const char* text) : text_(text) {}
    Name(std::string text) : text_(std::move(text)) {}
    static Name of_line(const char* file = __builtin_FILE(), int line = __builtin_LINE())
    {
        return {file, line};
    }

    /// E.g. "methods/glossy/glossy.cpp:131", relative to src.
    std::string text() const;

private:
    Name(const char* file, int line) : file_(file), line_(line) {}

    std::string text_;
    const char* file_ = "";
    int line_ = 0;
};

}  // namespace lumel::gpu
