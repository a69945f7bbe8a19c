#include "links/trace/sealed_space.h"

#include <algorithm>
#include <numeric>

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

/// What sees another is seen by it: a link joins both ways.
void SealedSpace::join_row(std::uint32_t lumel, const LinkRow& row)
{
    const auto join_end = [&](std::size_t k, LinkEnd end) {
        if (!numbers_.is_part(end.number()))
            return;
        const std::uint32_t from = root(parts_.first(lumel) + row.leaves(parts_, lumel, k));
        const std::uint32_t to = root(numbers_.part(end.number()));
        above_[std::max(from, to)] = std::min(from, to);
    };
    for (std::size_t k = 0; k < row.ends.size(); ++k)
        join_end(k, row.ends[k]);
    for (const NearLink& near : row.near)
        join_end(near.slot - row.first_slot, near.end);
}

void SealedSpace::join(const LinkTable& links, std::size_t table)
{
    rounds_.resize(std::max(rounds_.size(), table + 1), 0);
    for (std::size_t& r = rounds_[table]; r < links.rounds.size(); ++r)
        for (std::size_t b = 0; b < links.rounds[r].size(); ++b) {
            LinkRows rows(links.rounds[r][b]);
            const std::size_t end = std::min((b + 1) * kLinkBlock, work_.order.size());
            for (std::size_t o = b * kLinkBlock; o < end; ++o) {
                const std::uint32_t i = work_.order[o];
                join_row(i, rows.next(parts_.has_hidden(i)));
            }
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
