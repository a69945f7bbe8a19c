#pragma once
// Links of a solution in GPU memory, in slices.

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/array.h"
#include "links/direct/link_work.h"
#include "links/kept/link_table.h"
#include "links/sweeps/sweeps.shared.h"

namespace lumel {

/// Maximum memory of copied links [bytes].
struct DeviceLinkLimits {
    std::uint64_t bytes = 0;  ///< of the links that a call adds, 0: no limit
    std::uint64_t slab_bytes = std::uint64_t(64) << 20;  ///< of DeviceLinks::Slab::words
};

/// A copy of a LinkTable, without rays that end at no sub-lumel.
class DeviceLinks {
public:
    /// Slices of one round whose links fit into one array.
    struct Slab {
        gpu::Array<LinkSlice> slices;
        gpu::Array<std::uint32_t> words;
    };

    struct Numbering {
        const LinkWork& work;
        const SubLumels& parts;
        const LinkNumbers& numbers;
    };

    /// Adds the rounds that were added to `links` since the last call. Throws gpu::OutOfMemory if
    /// these take more than limits.bytes, or than the device has.
    void update(const gpu::Device& device, const Numbering& numbering, const LinkTable& links,
                const DeviceLinkLimits& limits = {});

    /// In the order of the rounds.
    std::span<const Slab> slabs() const { return slabs_; }
    std::uint64_t bytes() const { return bytes_; }

private:
    std::size_t rounds_ = 0;
    std::vector<Slab> slabs_;
    std::uint64_t bytes_ = 0;
};

}  // namespace lumel
