#pragma once
// Selection and ownership of a Vulkan device.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace lumel::gpu {

/// A device listed by the loader.
struct DeviceInfo {
    std::string name;
    std::string type;                ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;         ///< "1.3.230"
    std::string driver;              ///< name and version
    std::uint64_t memory_bytes = 0;  ///< size of the largest device-local heap
    /// Free memory of that heap when it was listed, by VK_EXT_memory_budget; without, its size.
    std::uint64_t free_bytes = 0;
    bool ray_queries = false;  ///< supports VK_KHR_ray_query
    bool usable = false;
    std::string reason;  ///< why it is not usable, else empty
};

/// All devices, in the loader's order. Throws Error{device} if there is no Vulkan loader.
std::vector<DeviceInfo> list_devices();

/// The default device among them; null if none is usable.
const DeviceInfo* best_of(const std::vector<DeviceInfo>& infos);

/// Numbers of recorded commands.
struct Recorded {
    std::uint64_t dispatches = 0, passes = 0, draws = 0;
};

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

/// Functions of VK_EXT_debug_utils, null if the instance lacks it.
struct DebugUtils {
    PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_region = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_region = nullptr;
};

class Memory;
class Staging;

/// A logical device with one queue for graphics, compute and transfer. Not copyable: objects made
/// from it refer to it and must not outlive it. Only one thread at a time may use it and them.
class Device {
public:
    /// `pick`: index into list_devices() or part of a name. Empty selects the best usable device,
    /// in the order discrete, integrated, virtual, cpu. Environment: LUMEL_VALIDATION=1 enables the
    /// Khronos validation layer. Throws Error{device} with the devices found and why each is
    /// unsuitable.
    explicit Device(const std::string& pick = "");
    /// Uses the device and queue of the host, which keeps ownership. The host must not use the
    /// queue during calls to this library, and destroys the device after this. Throws Error{device}
    /// if a handle is null or a required feature is missing.
    explicit Device(const HostDevice& host);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }

    /// Messages of the validation layers so far, one per line.
    std::string validation_messages() const;
    /// Throws Error{device} with these messages, if there are any.
    void check_validation() const;

    std::uint64_t max_array_bytes() const { return max_array_bytes_; }
    std::uint32_t max_image_side() const { return max_image_side_; }
    std::uint32_t max_groups() const { return max_groups_; }         ///< per dispatch
    bool can_list_fragments() const { return can_list_fragments_; }  ///< fragments may write arrays
    bool can_tessellate() const { return can_tessellate_; }  ///< supports tessellation shaders
    bool can_clip() const { return can_clip_; }              ///< supports clip distances of shaders
    bool can_read_blocks() const { return can_read_blocks_; }  ///< supports textures of Pixel::bc1
    bool can_blend_floats() const { return can_blend_floats_; }  ///< blends Pixel::rgba32
    bool can_query_rays() const { return can_query_rays_; }      ///< supports ray queries
    /// Alignment of scratch addresses for building trees [bytes].
    std::uint64_t scratch_alignment() const { return scratch_alignment_; }
    /// True if sample positions are Vulkan's standard ones.
    bool has_standard_samples() const { return standard_samples_; }
    /// Memory of arrays and images as requested: now, and the maximum so far.
    std::uint64_t held_bytes() const;
    std::uint64_t peak_bytes() const;

    /// Counts of all Commands of this device, which update them.
    Recorded& recorded() const { return recorded_; }

    /// Time between two timestamps, which may wrap around [ms].
    double milliseconds(std::uint64_t from, std::uint64_t to) const
    {
        return double((to - from) & timestamp_mask_) * timestamp_period_ * 1e-6;
    }

    VkInstance instance() const { return instance_; }
    VkPhysicalDevice physical() const { return physical_; }
    VkDevice handle() const { return device_; }
    VkQueue queue() const { return queue_; }
    std::uint32_t queue_family() const { return queue_family_; }
    const DebugUtils& debug_utils() const { return debug_utils_; }  ///< see names.h

    Memory& memory() const { return *memory_; }
    Staging& staging() const;  ///< created on first use

private:
    void load_debug_utils();
    void learn_limits();

    struct Validation;
    std::unique_ptr<Validation> validation_;
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    DebugUtils debug_utils_;
    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::uint32_t queue_family_ = 0;
    bool owned_ = true;  ///< false if the host owns instance and device
    DeviceInfo info_;
    std::uint64_t max_array_bytes_ = 0;
    std::uint32_t max_image_side_ = 0, max_groups_ = 0;
    bool can_tessellate_ = false, can_list_fragments_ = false, can_clip_ = false,
         can_read_blocks_ = false, can_query_rays_ = false, can_blend_floats_ = false,
         standard_samples_ = false;
    std::uint64_t scratch_alignment_ = 1;
    double timestamp_period_ = 1.0;  ///< [ns]
    std::uint64_t timestamp_mask_ = ~std::uint64_t(0);
    mutable Recorded recorded_;
    std::unique_ptr<Memory> memory_;
    mutable std::unique_ptr<Staging> staging_;
};

}  // namespace lumel::gpu
