#pragma once
// Whose links follow first when a thing moves.

#include <cstdint>
#include <vector>

#include "core/box.h"
#include "nearfield/world_lumels.h"

namespace lumel {

/// All lumels, in shells around a thing. Of the light of a lumel a move changes a share that is the
/// square of how large the lumel sees the thing; what its links cost is in proportion to that
/// share.
struct FollowOrder {
    std::vector<std::uint32_t> lumels;  ///< [N], those of a shell in their own order
    std::vector<std::size_t> ends;      ///< [shells] in `lumels`; no shell is empty

    /// Where the shell ends that the lumel at `place` of the order is in.
    std::size_t end_after(std::size_t place) const;
    bool ends_at(std::size_t place) const;
};
/// box: around the thing where it is now.
FollowOrder follow_order(const WorldLumels& world, const Box& box);

}  // namespace lumel
