#pragma once
// GPU memory suballocator. Uses large blocks: drivers limit the number of allocations, and each is
// slow.

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace lumel::gpu {

/// Use of memory. Each has separate blocks: arrays and images in one block would have to respect
/// VkPhysicalDeviceLimits::bufferImageGranularity.
enum class MemoryUse {
    array,      ///< on the device
    addressed,  ///< on the device, for arrays with an address
    image,      ///< on the device, with optimal tiling
    host,       ///< visible to the host, coherent and mapped
};

/// Memory allocated under one name.
struct Holding {
    std::string name;
    std::uint64_t bytes = 0;
};

/// Not thread-safe, as the device.
class Memory {
    struct Block;

public:
    /// A suballocation. A plain value: its owner returns it by give_back().
    struct Part {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint64_t offset = 0, bytes = 0;
        std::byte* mapped = nullptr;  ///< MemoryUse::host only
        Block* block = nullptr;
    };

    /// name: device name, for messages.
    Memory(VkPhysicalDevice physical, VkDevice device, const std::string& name);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// name: of the resource, see names.h. Throws OutOfMemory if there is too little memory,
    /// Error{device} if there is none of the required type.
    Part take(const VkMemoryRequirements& requirements, MemoryUse use, const std::string& name);
    void give_back(const Part& part);

    /// Allocations by name, largest first; parts of one name are summed.
    std::vector<Holding> holdings() const;
    std::uint64_t held_bytes() const { return held_bytes_; }  ///< sum of all parts
    std::uint64_t peak_bytes() const { return peak_bytes_; }  ///< maximum of held_bytes()
    std::size_t blocks() const { return blocks_.size(); }     ///< allocated from the driver

private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint32_t type = 0;
        MemoryUse use = MemoryUse::array;
        std::uint64_t bytes = 0;
        std::byte* mapped = nullptr;
        std::map<std::uint64_t, std::uint64_t> gaps;  ///< offset and length of free ranges
        std::map<std::uint64_t, Holding> held;        ///< by offset
    };

    bool take_from(Block& block, const VkMemoryRequirements& requirements, Part& part);
    bool take_of_type(std::uint32_t type, const VkMemoryRequirements& requirements, MemoryUse use,
                      Part& part);
    Block* add_block(std::uint32_t type, MemoryUse use, std::uint64_t bytes);

    VkDevice device_;
    std::string name_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::list<Block> blocks_;  ///< in order of allocation; list nodes do not move
    std::uint64_t held_bytes_ = 0, peak_bytes_ = 0;
};

}  // namespace lumel::gpu
