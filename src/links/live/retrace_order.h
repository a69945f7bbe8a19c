#pragma once
// Order in which links are retraced after a move.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "base/core/box.h"

namespace lumel {

/// All lumels in distance bands around an object: first close ones, which the move changes most;
/// then those on the object, which take longest, as all their links restart; then increasingly
/// distant ones.
struct RetraceOrder {
    std::vector<std::uint32_t> lumels;  ///< [N], by band
    std::vector<std::size_t> ends;      ///< [bands] end of each band in `lumels`; no band is empty
    std::size_t near = 0;               ///< end of the lumels on the object, in `lumels`

    /// End of the band that contains index `place`.
    std::size_t end_after(std::size_t place) const;
    bool ends_at(std::size_t place) const;
};
/// own: lumels on the object. box: its current bounds.
RetraceOrder follow_order(const WorldLumels& world, std::span<const std::uint32_t> own,
                          const Box& box);

}  // namespace lumel
