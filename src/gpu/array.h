#pragma once
// Arrays in GPU memory.

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "gpu/device.h"
#include "gpu/memory.h"
#include "gpu/names.h"

namespace lumel::gpu {

/// Bytes in GPU memory, usable as storage, vertex, index, indirect and transfer buffer.
class Buffer {
public:
    /// host: mapped, for readback and upload. addressed: on the GPU, with an address, as input to
    /// triangle trees.
    enum class Place { device, host, addressed };

    Buffer(const Device& device, std::uint64_t bytes, Place place = Place::device,
           const Name& name = Name::of_line());
    ~Buffer();
    Buffer(Buffer&& other) noexcept;
    Buffer& operator=(Buffer&& other) noexcept;

    VkBuffer handle() const { return buffer_; }
    std::uint64_t bytes() const { return bytes_; }
    std::byte* mapped() const { return memory_.mapped; }  ///< Place::host only

    /// Blocking copies between CPU and GPU.
    void upload(const void* data, std::uint64_t bytes, std::uint64_t to_byte = 0);
    void download(void* data, std::uint64_t bytes) const;

private:
    const Device* device_;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    Memory::Part memory_;
    std::uint64_t bytes_ = 0;
};

/// T[count] in GPU memory. An empty array occupies one element, so that it can be bound. Debuggers
/// show its name, by default the source line that creates it.
template <class T>
class Array {
public:
    Array(const Device& device, std::size_t count, const Name& name = Name::of_line())
        : Array(device, count, Buffer::Place::device, name)
    {
    }
    Array(const Device& device, std::size_t count, Buffer::Place place,
          const Name& name = Name::of_line())
        : count_(count),
          buffer_(device, (count > 0 ? count : 1) * sizeof(T), place, name)
    {
    }
    Array(const Device& device, std::span<const T> values, const Name& name = Name::of_line())
        : Array(device, values.size(), name)
    {
        upload(values);
    }

    std::size_t size() const { return count_; }
    const Buffer& buffer() const { return buffer_; }

    void upload(std::span<const T> values) { buffer_.upload(values.data(), values.size_bytes()); }
    /// Uploads elements from `first` on.
    void upload_part(std::size_t first, std::span<const T> values)
    {
        buffer_.upload(values.data(), values.size_bytes(), first * sizeof(T));
    }
    std::vector<T> download() const
    {
        std::vector<T> values(count_);
        buffer_.download(values.data(), count_ * sizeof(T));
        return values;
    }
    /// Place::host only: data last written by the GPU. Requires finished commands.
    const T* mapped() const { return reinterpret_cast<const T*>(buffer_.mapped()); }

private:
    std::size_t count_;
    Buffer buffer_;
};

}  // namespace lumel::gpu
