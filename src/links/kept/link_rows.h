#pragma once
// Loops over the rows of links, which ranks share by blocks: each keeps the links of its own.

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "base/ranks/rank_blocks.h"
#include "links/direct/link_work.h"
#include "links/kept/link_table.h"

namespace lumel {

/// Blocks of links per task.
inline constexpr std::size_t kRowBlocksPerTask = 4;

inline std::size_t blocks_of(const LinkWork& work)
{
    return (work.order.size() + kLinkBlock - 1) / kLinkBlock;
}

/// Lumels of a block, in order.
inline std::span<const std::uint32_t> lumels_of(const LinkWork& work, std::size_t block)
{
    const std::size_t first = block * kLinkBlock;
    return std::span(work.order).subspan(first, std::min(kLinkBlock, work.order.size() - first));
}

/// Sub-lumels of a block: [first, last).
struct PartRange {
    std::size_t first, last;
};
inline PartRange parts_of(const LinkWork& work, const SubLumels& parts, std::size_t block)
{
    const std::span<const std::uint32_t> lumels = lumels_of(work, block);
    return {parts.first(lumels.front()), parts.end(lumels.back())};
}

/// Calls visit(row, lumel) for the rows of a block in one round.
template <class Visit>
void visit_rows(const LinkWork& work, const SubLumels& parts, const LinkBlock& links,
                std::size_t block, const Visit& visit)
{
    LinkRows rows(links);
    for (const std::uint32_t i : lumels_of(work, block))
        visit(rows.next(parts.has_hidden(i)), i);
}

/// Calls visit(row, lumel) for all rows of this rank, in parallel; rows of one lumel one after
/// another.
template <class Visit>
void for_each_row(const LinkWork& work, const SubLumels& parts, const LinkTable& links,
                  const Visit& visit)
{
    parallel_for_own(work.ranks, 0, blocks_of(work), kRowBlocksPerTask,
                     [&](std::size_t first, std::size_t last) {
                         for (std::size_t b = first; b < last; ++b)
                             for (const std::vector<LinkBlock>& round : links.rounds)
                                 visit_rows(work, parts, round[b], b, visit);
                     });
}

/// Gives each rank what the others have found of their rows. state(archive, lumel).
template <class State>
void share_rows(const LinkWork& work, const State& state)
{
    share_blocks(work.ranks, 0, blocks_of(work), [&](auto& archive, std::size_t b) {
        for (const std::uint32_t i : lumels_of(work, b))
            state(archive, i);
    });
}

}  // namespace lumel
