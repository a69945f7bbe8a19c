#pragma once
// Copies between CPU and GPU memory.

#include <array>
#include <cstdint>
#include <memory>

#include "gpu/commands.h"

namespace lumel::gpu {

/// A ring of mapped memory with a command buffer per slot, shared by all uploads and downloads of a
/// device. Long copies are split: while the GPU copies one part, the CPU fills or reads the next.
/// Every call returns when its copy has finished.
class Staging {
public:
    explicit Staging(const Device& device);
    ~Staging();

    /// Size of all slots.
    static std::uint64_t device_bytes();

    void upload(const void* data, const Buffer& to, std::uint64_t bytes, std::uint64_t to_byte);
    void download(const Buffer& from, void* data, std::uint64_t bytes);
    /// Rows [first, first + count) of level 0, whole blocks, tightly packed.
    void upload(const void* pixels, const Target& to, std::uint32_t first, std::uint32_t count);
    /// Builds the smaller levels from level 0.
    void make_levels(const Target& target);
    /// Reads level 0.
    void download(const Target& from, void* pixels);
    /// Initial layout transition of a new image.
    void prepare(const Target& target);

private:
    struct Slot;
    static constexpr std::size_t kSlots = 4;

    template <class Begin, class End>
    void in_turn(std::uint64_t parts, const Begin& begin, const End& end);

    std::array<std::unique_ptr<Slot>, kSlots> slots_;
};

}  // namespace lumel::gpu
