#pragma once
// Choosing a Vulkan device and holding it.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace lumel::gpu {

/// One device as the loader lists it.
struct DeviceInfo {
    std::string name;
    std::string type;                ///< "discrete", "integrated", "virtual", "cpu" or "other"
    std::string api_version;         ///< "1.3.230"
    std::string driver;              ///< name and version
    std::uint64_t memory_bytes = 0;  ///< of its largest device-local heap
    bool usable = false;
    std::string reason;  ///< why not usable, empty if it is
};

/// All devices, in the loader's order. Throws Error{device} if there is no Vulkan loader.
std::vector<DeviceInfo> list_devices();

/// The one of them that a Device takes where none is named; null if none can be used.
const DeviceInfo* best_of(const std::vector<DeviceInfo>& infos);

/// How much work was recorded.
struct Recorded {
    std::uint64_t dispatches = 0, passes = 0, draws = 0;
};

/// A device that a host application made. It must have Vulkan 1.3, the extension
/// VK_KHR_push_descriptor, and these features on: dynamicRendering, synchronization2, maintenance4,
/// scalarBlockLayout, fullDrawIndexUint32.
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

/// Entry points of VK_EXT_debug_utils, null where the instance lacks it.
struct DebugUtils {
    PFN_vkSetDebugUtilsObjectNameEXT set_name = nullptr;
    PFN_vkCmdBeginDebugUtilsLabelEXT begin_region = nullptr;
    PFN_vkCmdEndDebugUtilsLabelEXT end_region = nullptr;
};

class Memory;
class Staging;

/// A logical device with one queue for graphics, compute and transfer. Not copyable: everything
/// made from it holds a reference and must not outlive it. One thread at a time may use it and what
/// is made from it.
class Device {
public:
    /// `pick`: an index or a part of a name as list_devices() gives them; empty: the best, which
    /// is discrete before integrated before virtual before cpu.
    /// Environment: LUMEL_VALIDATION=1 turns the Khronos validation layer on.
    /// Throws Error{device} listing what was found and why it will not do.
    explicit Device(const std::string& pick = "");
    /// Works on a host's device and queue, which stay the host's: it keeps its own work off the
    /// queue while calls to this library run, and destroys the device after this. Throws
    /// Error{device} if a handle is missing or the device cannot do what is needed.
    explicit Device(const HostDevice& host);
    ~Device();
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    const DeviceInfo& info() const { return info_; }

    /// Messages of the validation layers so far, one a line; empty: none.
    std::string validation_messages() const;
    /// Throws Error{device} with these messages, if there are any.
    void check_validation() const;

    std::uint64_t max_array_bytes() const { return max_array_bytes_; }
    std::uint32_t max_image_side() const { return max_image_side_; }
    std::uint32_t max_groups() const { return max_groups_; }         ///< of one dispatch
    bool can_list_fragments() const { return can_list_fragments_; }  ///< fragments may write arrays
    bool can_tessellate() const { return can_tessellate_; }          ///< has tessellation shaders
    bool can_clip() const { return can_clip_; }                      ///< by planes of a shader
    bool can_read_blocks() const { return can_read_blocks_; }        ///< has textures of Pixel::bc1
    bool can_query_rays() const { return can_query_rays_; }  ///< shaders may ask a TriangleTree
    /// Of an address that trees are built at [bytes].
    std::uint64_t scratch_alignment() const { return scratch_alignment_; }
    /// Are samples where Vulkan's standard has them?
    bool has_standard_samples() const { return standard_samples_; }
    /// Of arrays and images, as they asked for it: now, and the most at once.
    std::uint64_t held_bytes() const;
    std::uint64_t peak_bytes() const;

    /// By all Commands of this device so far; they count here themselves.
    Recorded& recorded() const { return recorded_; }

    /// Time between two timestamps, which may wrap round [ms].
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
    Staging& staging() const;  ///< made when it is first asked for

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
    bool owned_ = true;  ///< false: instance and device are a host's
    DeviceInfo info_;
    std::uint64_t max_array_bytes_ = 0;
    std::uint32_t max_image_side_ = 0, max_groups_ = 0;
    bool can_tessellate_ = false, can_list_fragments_ = false, can_clip_ = false,
         can_read_blocks_ = false, can_query_rays_ = false, standard_samples_ = false;
    std::uint64_t scratch_alignment_ = 1;
    double timestamp_period_ = 1.0;  ///< [ns]
    std::uint64_t timestamp_mask_ = ~std::uint64_t(0);
    mutable Recorded recorded_;
    std::unique_ptr<Memory> memory_;
    mutable std::unique_ptr<Staging> staging_;
};

}  // namespace lumel::gpu
