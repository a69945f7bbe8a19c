#include "gpu/staging.h"

#include <algorithm>
#include <cstring>

namespace lumel::gpu {
namespace {

/// Size of a slot; the colours of 170,000 lumels fit in one.
constexpr std::uint64_t kSlotBytes = std::uint64_t(2) << 20;

/// Splits `whole` into parts of at most `most`.
struct Parts {
    std::uint64_t whole, most;

    std::uint64_t count() const { return (whole + most - 1) / most; }
    std::uint64_t first(std::uint64_t part) const { return part * most; }
    std::uint64_t size(std::uint64_t part) const { return std::min(most, whole - first(part)); }
};

/// Contiguous rows of an image.
struct Rows {
    Rows(const Target& target, std::uint32_t count)
        : height(target.pixel() == Pixel::bc1 ? kBlockSide : 1),
          bytes(image_bytes(target.pixel(), target.width(), height)),
          parts{count / height, kSlotBytes / bytes}
    {
    }

    std::uint32_t pixels(std::uint64_t rows) const { return std::uint32_t(rows) * height; }

    static constexpr std::uint32_t kBlockSide = 4;  // Pixel::bc1

    std::uint32_t height;  ///< row height [pixels]
    std::uint64_t bytes;   ///< size of a row
    Parts parts;           ///< [rows]
};

}  // namespace

struct Staging::Slot {
    explicit Slot(const Device& device)
        : commands(device, Timing::off),
          memory(device, kSlotBytes, Buffer::Place::host, "staging")
    {
    }

    Commands commands;
    Buffer memory;
};

std::uint64_t Staging::device_bytes()
{
    return kSlots * kSlotBytes;
}

Staging::Staging(const Device& device)
{
    for (auto& slot : slots_)
        slot = std::make_unique<Slot>(device);
}

Staging::~Staging() = default;

/// Records and submits `begin` for each part, and calls `end` for it when the GPU is done, with the
/// next parts already in flight.
template <class Begin, class End>
void Staging::in_turn(std::uint64_t parts, const Begin& begin, const End& end)
{
    for (std::uint64_t part = 0; part < parts + kSlots; ++part) {
        Slot& slot = *slots_[part % kSlots];
        if (part >= kSlots && part - kSlots < parts) {
            slot.commands.wait();
            end(slot, part - kSlots);
        }
        if (part < parts) {
            begin(slot, part);
            slot.commands.submit();
        }
    }
}

void Staging::upload(const void* data, const Buffer& to, std::uint64_t bytes, std::uint64_t to_byte)
{
    const Parts parts{bytes, kSlotBytes};
    const auto fill = [&](Slot& slot, std::uint64_t part) {
        std::memcpy(slot.memory.mapped(), static_cast<const std::byte*>(data) + parts.first(part),
                    parts.size(part));
        slot.commands.stage("upload");
        slot.commands.copy_part(slot.memory, 0, to, to_byte + parts.first(part), parts.size(part));
    };
    in_turn(parts.count(), fill, [](Slot&, std::uint64_t) {});
}

void Staging::download(const Buffer& from, void* data, std::uint64_t bytes)
{
    const Parts parts{bytes, kSlotBytes};
    const auto fetch = [&](Slot& slot, std::uint64_t part) {
        slot.commands.stage("download");
        slot.commands.copy_part(from, parts.first(part), slot.memory, 0, parts.size(part));
    };
    const auto take = [&](const Slot& slot, std::uint64_t part) {
        std::memcpy(static_cast<std::byte*>(data) + parts.first(part), slot.memory.mapped(),
                    parts.size(part));
    };
    in_turn(parts.count(), fetch, take);
}

void Staging::upload(const void* pixels, const Target& to, std::uint32_t first_row,
                     std::uint32_t row_count)
{
    const Rows rows(to, row_count);
    const auto fill = [&](Slot& slot, std::uint64_t part) {
        const std::uint64_t first = rows.parts.first(part), count = rows.parts.size(part);
        std::memcpy(slot.memory.mapped(),
                    static_cast<const std::byte*>(pixels) + first * rows.bytes, count * rows.bytes);
        slot.commands.stage("upload");
        slot.commands.copy_rows(slot.memory, to, first_row + rows.pixels(first),
                                rows.pixels(count));
    };
    in_turn(rows.parts.count(), fill, [](Slot&, std::uint64_t) {});
}

void Staging::make_levels(const Target& target)
{
    slots_[0]->commands.make_levels(target);
    slots_[0]->commands.run();
}

void Staging::download(const Target& from, void* pixels)
{
    const Rows rows(from, from.height());
    const auto fetch = [&](Slot& slot, std::uint64_t part) {
        slot.commands.stage("download");
        slot.commands.copy_rows(from, slot.memory, rows.pixels(rows.parts.first(part)),
                                rows.pixels(rows.parts.size(part)));
    };
    const auto take = [&](const Slot& slot, std::uint64_t part) {
        std::memcpy(static_cast<std::byte*>(pixels) + rows.parts.first(part) * rows.bytes,
                    slot.memory.mapped(), rows.parts.size(part) * rows.bytes);
    };
    in_turn(rows.parts.count(), fetch, take);
}

void Staging::prepare(const Target& target)
{
    slots_[0]->commands.prepare(target);
    slots_[0]->commands.run();
}

}  // namespace lumel::gpu
