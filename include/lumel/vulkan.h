// Lumel on a Vulkan device of the host, and lightmaps that stay on it. See lumel/lumel.h.
#ifndef LUMEL_VULKAN_H
#define LUMEL_VULKAN_H

#include <vulkan/vulkan_core.h>

#include "lumel/lumel.h"

namespace lumel::v0 {

/// A Vulkan device created by the host. Requires Vulkan 1.3, the extension VK_KHR_push_descriptor,
/// and the features dynamicRendering, synchronization2, maintenance4, scalarBlockLayout and
/// fullDrawIndexUint32.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  ///< for graphics, compute and transfer
    std::uint32_t queue_family = 0;
    bool tessellation = false;     ///< feature tessellationShader is enabled
    bool fragment_stores = false;  ///< feature fragmentStoresAndAtomics is enabled
    bool block_textures = false;   ///< feature textureCompressionBC is enabled
    /// VK_KHR_ray_query and its dependencies are enabled, with the features rayQuery,
    /// accelerationStructure and bufferDeviceAddress.
    bool ray_queries = false;
};

/// Uses the device and queue of the host, which keeps ownership. The host must not use the queue
/// during calls to Lumel, and must destroy the device last. Throws Error{device} if a handle is
/// null or a required feature is missing.
LUMEL_API Device use_device(const HostDevice& host);

/// An image owned by Lumel on the Device's VkDevice, in the general layout, ready for sampling.
struct DeviceImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 0, height = 0;
};

/// The lightmap after the last update(): RGB is H [lx] of front sides, A is 1 on surfaces, else 0;
/// gutters are empty. VK_FORMAT_R32G32B32A32_SFLOAT. Two images alternate: an update() that changes
/// the lightmap leaves the previous image readable. They live as long as the LiveScene.
LUMEL_API DeviceImage device_image(const LiveScene& live);

}  // namespace lumel::v0

#endif
