#include "gpu/memory.h"

#include <algorithm>
#include <iterator>

namespace lumel::gpu {
namespace {

/// Size of a shared block. A bake needs a few dozen, and the last one wastes little.
constexpr std::uint64_t kBlockBytes = std::uint64_t(64) << 20;
/// Limits the block size in small heaps, such as 256 MiB of host-visible memory of a graphics card.
constexpr std::uint64_t kBlocksInHeap = 16;
/// Larger requests than this fraction of a block have their own.
constexpr std::uint64_t kShareOfBlock = 2;

constexpr VkMemoryPropertyFlags kCoherent =
    VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

struct Wishes {
    VkMemoryPropertyFlags best, enough;
};

/// Prefers cached host memory, for readback; falls back to any suitable type.
Wishes wishes_of(MemoryUse use)
{
    if (use == MemoryUse::host)
        return {kCoherent | VK_MEMORY_PROPERTY_HOST_CACHED_BIT, kCoherent};
    return {VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, 0};
}

std::uint64_t aligned(std::uint64_t offset, std::uint64_t alignment)
{
    return (offset + alignment - 1) / alignment * alignment;
}

}  // namespace

Memory::Memory(VkPhysicalDevice physical, VkDevice device, const std::string& name)
    : device_(device),
      name_(name)
{
    vkGetPhysicalDeviceMemoryProperties(physical, &properties_);
}

Memory::~Memory()
{
    for (const Block& block : blocks_)
        vkFreeMemory(device_, block.memory, nullptr);
}

Memory::Part Memory::take(const VkMemoryRequirements& requirements, MemoryUse use,
                          const std::string& name)
{
    Part part;
    bool suits = false;
    const Wishes wishes = wishes_of(use);
    for (const VkMemoryPropertyFlags wish : {wishes.best, wishes.enough})
        for (std::uint32_t type = 0; type < properties_.memoryTypeCount; ++type) {
            if (!(requirements.memoryTypeBits >> type & 1u) ||
                (properties_.memoryTypes[type].propertyFlags & wish) != wish)
                continue;
            suits = true;
            if (!take_of_type(type, requirements, use, part))
                continue;
            part.block->held[part.offset] = {name, part.bytes};
            held_bytes_ += part.bytes;
            peak_bytes_ = std::max(peak_bytes_, held_bytes_);
            return part;
        }
    if (!suits)
        throw Error(ErrorKind::device, name_, "has no memory of the kind needed");
    throw OutOfMemory(name_, "is out of memory; use a smaller --size");
}

bool Memory::take_of_type(std::uint32_t type, const VkMemoryRequirements& requirements,
                          MemoryUse use, Part& part)
{
    const std::uint64_t heap =
        properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
    if (requirements.size > heap)  // VUID-vkAllocateMemory-pAllocateInfo-01713
        return false;
    const std::uint64_t shared = std::min(kBlockBytes, heap / kBlocksInHeap);
    Block* block = nullptr;
    if (requirements.size <= shared / kShareOfBlock) {
        for (Block& other : blocks_)
            if (other.type == type && other.use == use && take_from(other, requirements, part))
                return true;
        block = add_block(type, use, shared);
    }
    if (!block)  // too large to share a block, or no memory for a shared one
        block = add_block(type, use, requirements.size);
    return block && take_from(*block, requirements, part);
}

bool Memory::take_from(Block& block, const VkMemoryRequirements& requirements, Part& part)
{
    for (auto gap = block.gaps.begin(); gap != block.gaps.end(); ++gap) {
        const auto [begin, length] = *gap;
        const std::uint64_t offset = aligned(begin, requirements.alignment);
        const std::uint64_t end = offset + requirements.size;
        if (end > begin + length)
            continue;
        block.gaps.erase(gap);
        if (offset > begin)
            block.gaps.emplace(begin, offset - begin);
        if (end < begin + length)
            block.gaps.emplace(end, begin + length - end);
        part = {block.memory, offset, requirements.size,
                block.mapped ? block.mapped + offset : nullptr, &block};
        return true;
    }
    return false;
}

Memory::Block* Memory::add_block(std::uint32_t type, MemoryUse use, std::uint64_t bytes)
{
    const VkMemoryAllocateFlagsInfo addresses{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                              .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT};
    const VkMemoryAllocateInfo info{.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                    .pNext = use == MemoryUse::addressed ? &addresses : nullptr,
                                    .allocationSize = bytes,
                                    .memoryTypeIndex = type};
    VkDeviceMemory memory = VK_NULL_HANDLE;
    const VkResult result = vkAllocateMemory(device_, &info, nullptr, &memory);
    if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
        return nullptr;
    check(result, "vkAllocateMemory");
    Block& block = blocks_.emplace_back(Block{memory, type, use, bytes, nullptr, {{0, bytes}}});
    if (use == MemoryUse::host) {
        void* mapped = nullptr;
        check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "vkMapMemory");
        block.mapped = static_cast<std::byte*>(mapped);
    }
    return &block;
}

void Memory::give_back(const Part& part)
{
    held_bytes_ -= part.bytes;
    part.block->held.erase(part.offset);
    auto& gaps = part.block->gaps;
    auto gap = gaps.emplace(part.offset, part.bytes).first;
    if (const auto next = std::next(gap);
        next != gaps.end() && gap->first + gap->second == next->first) {
        gap->second += next->second;
        gaps.erase(next);
    }
    if (gap != gaps.begin())
        if (const auto before = std::prev(gap); before->first + before->second == gap->first) {
            before->second += gap->second;
            gaps.erase(gap);
        }
    if (gaps.size() > 1 || gaps.begin()->second < part.block->bytes)
        return;
    vkFreeMemory(device_, part.memory, nullptr);
    blocks_.remove_if([&](const Block& block) { return &block == part.block; });
}

std::vector<Holding> Memory::holdings() const
{
    std::map<std::string, std::uint64_t> sums;
    for (const Block& block : blocks_)
        for (const auto& [offset, held] : block.held)
            sums[held.name] += held.bytes;
    std::vector<Holding> holdings;
    for (const auto& [name, bytes] : sums)
        holdings.push_back({name, bytes});
    std::stable_sort(holdings.begin(), holdings.end(),
                     [](const Holding& a, const Holding& b) { return a.bytes > b.bytes; });
    return holdings;
}

}  // namespace lumel::gpu
