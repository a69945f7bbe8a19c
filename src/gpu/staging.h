#pragma once
// Copies between the host's memory and the device's.

#include <array>
#include <cstdint>
#include <memory>

#include "gpu/commands.h"

namespace lumel::gpu {

/// A ring of mapped memory with a command buffer for each of its slots, made once and used for
/// every upload and download of a device. Long copies go in parts: while the device copies one,
/// the host fills or reads the next. Every call returns once its copy has ended.
class Staging {
public:
    explicit Staging(const Device& device);
    ~Staging();

    /// Of all slots.
    static std::uint64_t device_bytes();

    void upload(const void* data, const Buffer& to, std::uint64_t bytes, std::uint64_t to_byte);
    void download(const Buffer& from, void* data, std::uint64_t bytes);
    /// Rows [first, first + count) of level 0, whole blocks, tightly packed.
    void upload(const void* pixels, const Target& to, std::uint32_t first, std::uint32_t count);
    /// The smaller levels, of level 0.
    void make_levels(const Target& target);
    /// Level 0.
    void download(const Target& from, void* pixels);
    /// A new image's first use.
    void prepare(const Target& target);

private:
    struct Slot;
    static constexpr std::size_t kSlots = 4;

    template <class Begin, class End>
    void in_turn(std::uint64_t parts, const Begin& begin, const End& end);

    std::array<std::unique_ptr<Slot>, kSlots> slots_;
};

}  // namespace lumel::gpu
