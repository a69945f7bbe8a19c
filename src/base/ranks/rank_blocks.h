#pragma once
// Loops over blocks that ranks share: block b is of rank b mod count, in every loop.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "base/core/state_bytes.h"
#include "base/ranks/ranks.h"

namespace lumel {

/// Ranks that share a loop: 1 for null, which stands for a process of its own.
inline std::size_t count_of(const Ranks* ranks)
{
    return ranks ? ranks->count() : 1;
}

inline bool is_own(const Ranks* ranks, std::size_t block)
{
    return count_of(ranks) == 1 || block % ranks->count() == ranks->rank();
}

/// parallel_for over the blocks of [first, last) that are this rank's.
void parallel_for_own(const Ranks* ranks, std::size_t first, std::size_t last, std::size_t grain,
                      const std::function<void(std::size_t first, std::size_t last)>& body);
/// The same over those of the other ranks.
void parallel_for_others(const Ranks* ranks, std::size_t first, std::size_t last, std::size_t grain,
                         const std::function<void(std::size_t first, std::size_t last)>& body);

/// For share_blocks(): writes a block, and reads it.
struct BlockArchives {
    std::function<void(StateWriter& writer, std::size_t block)> write;
    std::function<void(StateReader& reader, std::size_t block)> read;
};
void share_blocks(Ranks* ranks, std::size_t first, std::size_t last, const BlockArchives& archives);

/// After the ranks have worked on their blocks of [first, last): gives each rank those of the
/// others. state(archive, block): reads or writes one, as in state_bytes.h, on all cores.
template <class State>
void share_blocks(Ranks* ranks, std::size_t first, std::size_t last, const State& state)
{
    share_blocks(ranks, first, last, BlockArchives{.write = state, .read = state});
}

/// The same for blocks whose bytes stay in place: of(block).
void share_bytes(Ranks* ranks, std::size_t first, std::size_t last,
                 const std::function<std::span<std::byte>(std::size_t block)>& of);

/// Adds the sums of all ranks. Integers, since sums of rounded numbers depend on their order.
void add_up(Ranks* ranks, std::span<std::int64_t> sums);

}  // namespace lumel
