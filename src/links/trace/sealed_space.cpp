#include "links/trace/sealed_space.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <span>

#include "links/kept/link_rows.h"

namespace lumel {

SealedSpace::SealedSpace(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers)
    : work_(work),
      parts_(parts),
      numbers_(numbers),
      above_(parts.count())
{
    std::iota(above_.begin(), above_.end(), 0u);
}

std::uint32_t SealedSpace::root(std::uint32_t part)
{
    while (above_[part] != part)
        part = above_[part] = above_[above_[part]];
    return part;
}

/// Returns false if they were joined already.
bool SealedSpace::unite(std::uint32_t part, std::uint32_t other)
{
    const std::uint32_t a = root(part), b = root(other);
    above_[std::max(a, b)] = std::min(a, b);
    return a != b;
}

/// What sees another is seen by it: a link joins both ways.
void SealedSpace::join_row(std::uint32_t lumel, const LinkRow& row)
{
    const auto join_end = [&](std::size_t k, LinkEnd end) {
        if (!numbers_.is_part(end.number()))
            return;
        const Pair pair{parts_.first(lumel) + row.leaves(parts_, lumel, k),
                        numbers_.part(end.number())};
        if (unite(pair.part, pair.other))
            joined_.push_back(pair);
    };
    for (std::size_t k = 0; k < row.ends.size(); ++k)
        join_end(k, row.ends[k]);
    for (const NearLink& near : row.near)
        join_end(near.slot - row.first_slot, near.end);
}

void SealedSpace::join(const LinkTable& links, std::size_t table)
{
    rounds_.resize(std::max(rounds_.size(), table + 1), 0);
    joined_.clear();
    for (std::size_t& r = rounds_[table]; r < links.rounds.size(); ++r)
        for (std::size_t b = 0; b < links.rounds[r].size(); ++b)
            if (is_own(work_.ranks, b))
                visit_rows(work_, parts_, links.rounds[r][b], b,
                           [&](const LinkRow& row, std::uint32_t i) { join_row(i, row); });
    share_joined();
}

/// Joins what the other ranks have joined.
void SealedSpace::share_joined()
{
    if (count_of(work_.ranks) == 1)
        return;
    const Ranks::Gathered all = work_.ranks->all_gather(std::as_bytes(std::span(joined_)));
    for (std::size_t at = 0; at < all.bytes.size(); at += sizeof(Pair)) {
        Pair pair;
        std::memcpy(&pair, &all.bytes[at], sizeof pair);
        unite(pair.part, pair.other);
    }
}

std::vector<char> SealedSpace::sealed(const std::vector<char>& lit)
{
    std::vector<char> lit_root(above_.size(), 0);
    for (std::uint32_t p = 0; p < above_.size(); ++p)
        if (lit[p])
            lit_root[root(p)] = 1;
    std::vector<char> sealed(work_.lumels().size(), 1);
    for (std::uint32_t p = 0; p < above_.size(); ++p)
        if (lit_root[root(p)])
            sealed[parts_.lumel(p)] = 0;
    return sealed;
}

}  // namespace lumel
