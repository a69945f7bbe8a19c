#pragma once
// Names for people who debug: RenderDoc, Nsight and validation messages show them. All of this does
// nothing where the instance lacks VK_EXT_debug_utils.

#include <string>

#include "gpu/device.h"

namespace lumel::gpu {

/// What a debugger calls an object.
void set_name(const Device& device, VkBuffer buffer, const std::string& name);
void set_name(const Device& device, VkImage image, const std::string& name);
void set_name(const Device& device, VkImageView view, const std::string& name);
void set_name(const Device& device, VkPipeline pipeline, const std::string& name);
void set_name(const Device& device, VkCommandBuffer commands, const std::string& name);
void set_name(const Device& device, VkDeviceMemory memory, const std::string& name);

/// A named region of a command buffer, from here to the matching end_region().
void begin_region(const Device& device, VkCommandBuffer commands, const char* name);
void end_region(const Device& device, VkCommandBuffer commands);

/// The name of an array or an image: a text of its own, or the line of source that makes it. As a
/// default argument it takes the line of the call.
class Name {
public:
    Name(const char* text) : text_(text) {}
    Name(std::string text) : text_(std::move(text)) {}
    static Name of_line(const char* file = __builtin_FILE(), int line = __builtin_LINE())
    {
        return {file, line};
    }

    /// "methods/glossy/glossy.cpp:131", without the folders above the room.
    std::string text() const;

private:
    Name(const char* file, int line) : file_(file), line_(line) {}

    std::string text_;
    const char* file_ = "";
    int line_ = 0;
};

}  // namespace lumel::gpu
