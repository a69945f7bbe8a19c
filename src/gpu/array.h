#pragma once
// Arrays in GPU memory.

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"

namespace lumel::gpu {

/// Bytes in GPU memory, usable as storage, vertex, index and transfer buffer.
class Buffer {
public:
    enum class Place { device, host };  ///< host: mapped, for read-backs and uploads

    Buffer(const Device& device, std::uint64_t bytes, Place place = Place::device);
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    std::uint64_t bytes() const { return bytes_; }
    std::byte* mapped() const { return static_cast<std::byte*>(mapped_); }  ///< host place only

    /// Blocking copies between host and device.
    void upload(const void* data, std::uint64_t bytes);
    void download(void* data, std::uint64_t bytes) const;

private:
    const Device* device_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    std::uint64_t bytes_ = 0, allocated_ = 0;
    void* mapped_ = nullptr;
};

/// T[count] in GPU memory. An empty array still occupies one element, so it can be bound.
template <class T>
class Array {
public:
    Array(const Device& device, std::size_t count, Buffer::Place place = Buffer::Place::device)
        : count_(count),
          buffer_(device, (count > 0 ? count : 1) * sizeof(T), place)
    {
    }
    Array(const Device& device, std::span<const T> values) : Array(device, values.size())
    {
        upload(values);
    }

    std::size_t size() const { return count_; }
    const Buffer& buffer() const { return buffer_; }

    void upload(std::span<const T> values) { buffer_.upload(values.data(), values.size_bytes()); }
    std::vector<T> download() const
    {
        std::vector<T> values(count_);
        buffer_.download(values.data(), count_ * sizeof(T));
        return values;
    }
    /// Host place only: what the device last wrote, once its commands have finished.
    const T* mapped() const { return reinterpret_cast<const T*>(buffer_.mapped()); }

private:
    std::size_t count_;
    Buffer buffer_;
};

}  // namespace lumel::gpu
