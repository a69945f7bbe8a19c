#include "gpu/array.h"

#include <utility>

#include "gpu/staging.h"

namespace lumel::gpu {
namespace {

VkBufferUsageFlags usage_of(Buffer::Place place)
{
    const VkBufferUsageFlags any =
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
        VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
        VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT |
        VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    const VkBufferUsageFlags of_trees =
        VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
        VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_STORAGE_BIT_KHR |
        VK_BUFFER_USAGE_ACCELERATION_STRUCTURE_BUILD_INPUT_READ_ONLY_BIT_KHR;
    return place == Buffer::Place::addressed ? any | of_trees : any;
}

MemoryUse memory_use_of(Buffer::Place place)
{
    switch (place) {
    case Buffer::Place::device:
        return MemoryUse::array;
    case Buffer::Place::host:
        return MemoryUse::host;
    case Buffer::Place::addressed:
        return MemoryUse::addressed;
    }
    return MemoryUse::array;
}

}  // namespace

Buffer::Buffer(const Device& device, std::uint64_t bytes, Place place, const Name& name)
    : device_(&device),
      bytes_(bytes)
{
    if (place == Place::device && bytes > device.max_array_bytes())
        throw OutOfMemory(device.info().name, "an array of " + std::to_string(bytes >> 20) +
                                                  " MiB is larger than the " +
                                                  std::to_string(device.max_array_bytes() >> 20) +
                                                  " MiB this device allows; use a smaller --size");
    const VkBufferCreateInfo info{
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage_of(place)};
    check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer_), "vkCreateBuffer");
    VkMemoryRequirements requirements;
    vkGetBufferMemoryRequirements(device.handle(), buffer_, &requirements);
    try {
        memory_ = device.memory().take(requirements, memory_use_of(place), name.text());
    } catch (...) {
        vkDestroyBuffer(device.handle(), buffer_, nullptr);
        throw;
    }
    check(vkBindBufferMemory(device.handle(), buffer_, memory_.memory, memory_.offset),
          "vkBindBufferMemory");
    set_name(device, VK_OBJECT_TYPE_BUFFER, buffer_, name.text());
}

Buffer::~Buffer()
{
    if (!buffer_)
        return;
    vkDestroyBuffer(device_->handle(), buffer_, nullptr);
    device_->memory().give_back(memory_);
}

Buffer::Buffer(Buffer&& other) noexcept
    : device_(other.device_),
      buffer_(std::exchange(other.buffer_, VK_NULL_HANDLE)),
      memory_(other.memory_),
      bytes_(other.bytes_)
{
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    std::swap(device_, other.device_);
    std::swap(buffer_, other.buffer_);
    std::swap(memory_, other.memory_);
    std::swap(bytes_, other.bytes_);
    return *this;
}

void Buffer::upload(const void* data, std::uint64_t bytes, std::uint64_t to_byte)
{
    if (bytes == 0)
        return;
    if (mapped())
        std::memcpy(mapped() + to_byte, data, bytes);
    else
        device_->staging().upload(data, *this, bytes, to_byte);
}

void Buffer::download(void* data, std::uint64_t bytes) const
{
    if (bytes == 0)
        return;
    if (mapped())
        std::memcpy(data, mapped(), bytes);
    else
        device_->staging().download(*this, data, bytes);
}

}  // namespace lumel::gpu
