// Lumel on a Vulkan device of the host's, and lightmaps that stay on it. See lumel/lumel.h.
#ifndef LUMEL_VULKAN_H
#define LUMEL_VULKAN_H

#include <vulkan/vulkan_core.h>

#include "lumel/lumel.h"

namespace lumel::v0 {

/// A device that the host has made. It must have Vulkan 1.3, the extension VK_KHR_push_descriptor,
/// and these features on: dynamicRendering, synchronization2, maintenance4, scalarBlockLayout,
/// fullDrawIndexUint32.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;  ///< for graphics, compute and transfer
    std::uint32_t queue_family = 0;
    bool tessellation = false;     ///< the feature tessellationShader is on
    bool fragment_stores = false;  ///< the feature fragmentStoresAndAtomics is on
    bool block_textures = false;   ///< the feature textureCompressionBC is on
    /// VK_KHR_ray_query and what it needs are on, with the features rayQuery, accelerationStructure
    /// and bufferDeviceAddress.
    bool ray_queries = false;
};

/// Works on the host's device and queue, which stay the host's: it keeps its own work off the queue
/// while calls to Lumel run, and destroys the device after all that was made with it.
/// Throws Error{device} if a handle is null or the device cannot do what is needed.
LUMEL_API Device use_device(const HostDevice& host);

/// An image of Lumel's on the Device's VkDevice, in the general layout, ready to be sampled.
struct DeviceImage {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkFormat format = VK_FORMAT_UNDEFINED;
    std::uint32_t width = 0, height = 0;
};

/// The lightmap as the last update() left it: RGB is H [lx] of front sides, A is 1 where a surface
/// is, else 0; gutters are empty. VK_FORMAT_R32G32B32A32_SFLOAT. Each update() that changes it
/// draws into the other of two images, so that the host may still read the one before. They live
/// as long as the LiveScene.
LUMEL_API DeviceImage device_image(const LiveScene& live);

}  // namespace lumel::v0

#endif
