#pragma once
// Whose links follow first when a thing moves.

#include <cstdint>
#include <span>
#include <vector>

#include "atlas/near/world_lumels.h"
#include "base/core/box.h"

namespace lumel {

/// All lumels, in shells around a thing: those close to it, whose light a move changes most; those
/// on it, which take longest, as all their links start elsewhere; then farther and farther ones.
struct RetraceOrder {
    std::vector<std::uint32_t> lumels;  ///< [N], those of a shell in their own order
    std::vector<std::size_t> ends;      ///< [shells] in `lumels`; no shell is empty
    std::size_t near = 0;               ///< in `lumels`: end of those on the thing

    /// Where the shell ends that the lumel at `place` of the order is in.
    std::size_t end_after(std::size_t place) const;
    bool ends_at(std::size_t place) const;
};
/// own: lumels on the thing. box: around it where it is now.
RetraceOrder follow_order(const WorldLumels& world, std::span<const std::uint32_t> own,
                          const Box& box);

}  // namespace lumel
