#include "gpu/names.h"

#include <string_view>

namespace lumel::gpu {
namespace {

/// The path below the folder "src", or the file name alone.
std::string_view short_path(std::string_view path)
{
    constexpr std::string_view root = "src/";
    const std::size_t source = path.rfind(root);
    if (source != std::string_view::npos && (source == 0 || path[source - 1] == '/'))
        return path.substr(source + root.size());
    return path.substr(path.rfind('/') + 1);
}

}  // namespace

void set_name(const Device& device, VkObjectType type, const void* handle, const std::string& name)
{
    if (!device.debug_utils().set_name)
        return;
    const VkDebugUtilsObjectNameInfoEXT info{
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT,
        .objectType = type,
        .objectHandle = reinterpret_cast<std::uint64_t>(handle),
        .pObjectName = name.c_str()};
    check(device.debug_utils().set_name(device.handle(), &info), "vkSetDebugUtilsObjectNameEXT");
}

void begin_region(const Device& device, VkCommandBuffer commands, const char* name)
{
    if (!device.debug_utils().begin_region)
        return;
    const VkDebugUtilsLabelEXT label{.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT,
                                     .pLabelName = name};
    device.debug_utils().begin_region(commands, &label);
}

void end_region(const Device& device, VkCommandBuffer commands)
{
    if (device.debug_utils().end_region)
        device.debug_utils().end_region(commands);
}

std::string Name::text() const
{
    if (!text_.empty())
        return text_;
    return std::string(short_path(file_)) + ":" + std::to_string(line_);
}

}  // namespace lumel::gpu
