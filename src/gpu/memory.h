#pragma once
// Memory of a device, taken from the driver in large blocks and lent out in parts: drivers allow
// only some thousands of allocations, and each costs time.

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace lumel::gpu {

/// What memory is used for. Each has blocks of its own: arrays and images in one block would have
/// to keep VkPhysicalDeviceLimits::bufferImageGranularity apart.
enum class MemoryUse {
    array,      ///< on the device
    addressed,  ///< on the device, for arrays that have an address
    image,      ///< on the device, with optimal tiling
    host,       ///< visible to the host, coherent and mapped
};

/// Memory that is held under one name.
struct Holding {
    std::string name;
    std::uint64_t bytes = 0;
};

/// Not thread-safe, as the device it belongs to.
class Memory {
    struct Block;

public:
    /// A part of a block. A plain value: who holds it gives it back.
    struct Part {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint64_t offset = 0, bytes = 0;
        std::byte* mapped = nullptr;  ///< MemoryUse::host only
        Block* block = nullptr;
    };

    /// name: of the device, for messages.
    Memory(VkPhysicalDevice physical, VkDevice device, const std::string& name);
    ~Memory();
    Memory(const Memory&) = delete;
    Memory& operator=(const Memory&) = delete;

    /// name: of what the memory is for, see names.h. Throws Error{device} if there is too little
    /// memory or none of the kind needed.
    Part take(const VkMemoryRequirements& requirements, MemoryUse use, const std::string& name);
    void give_back(const Part& part);

    /// What is held, by name; parts of one name count as one. The largest come first.
    std::vector<Holding> holdings() const;
    std::uint64_t held_bytes() const { return held_bytes_; }  ///< by all parts together
    std::uint64_t peak_bytes() const { return peak_bytes_; }  ///< most that was held at once
    std::size_t blocks() const { return blocks_.size(); }     ///< taken from the driver

private:
    struct Block {
        VkDeviceMemory memory = VK_NULL_HANDLE;
        std::uint32_t type = 0;
        MemoryUse use = MemoryUse::array;
        std::uint64_t bytes = 0;
        std::byte* mapped = nullptr;
        std::map<std::uint64_t, std::uint64_t> gaps;  ///< offset and length of what is free
        std::map<std::uint64_t, Holding> held;        ///< by offset
    };

    bool take_from(Block& block, const VkMemoryRequirements& requirements, Part& part);
    bool take_of_type(std::uint32_t type, const VkMemoryRequirements& requirements, MemoryUse use,
                      Part& part);
    Block* add_block(std::uint32_t type, MemoryUse use, std::uint64_t bytes);

    VkDevice device_;
    std::string name_;
    VkPhysicalDeviceMemoryProperties properties_{};
    std::list<Block> blocks_;  ///< in the order taken; their places in memory stay
    std::uint64_t held_bytes_ = 0, peak_bytes_ = 0;
};

}  // namespace lumel::gpu
