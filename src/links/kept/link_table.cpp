#include "links/kept/link_table.h"

#include <algorithm>

#include "base/core/error.h"
#include "links/kept/link_rows.h"

namespace lumel {
namespace {

/// More than any ray of a guide weighs.
constexpr float kMaxWeight = 1e3f;

bool fits(std::span<const NearShare> shares, std::size_t near, const LinkNumbers& numbers,
          std::size_t lamps)
{
    std::size_t first = 0;
    for (const NearShare& share : shares) {
        const bool is_of_all = share.lamp == NearShare::kEveryLamp;
        if (share.near < first || share.near >= near || (!is_of_all && share.lamp >= lamps) ||
            (is_of_all && !numbers.is_part(share.at.number())))
            return false;
        first = share.near;
    }
    return true;
}

bool fits(const LinkBlock& block, std::span<const std::uint32_t> lumels, const SubLumels& parts,
          const LinkNumbers& numbers, std::size_t lamps, bool has_bins)
{
    if (block.rays.size() != lumels.size())
        return false;
    std::size_t slots = 0, with_cell = 0;
    for (std::size_t n = 0; n < lumels.size(); ++n) {
        slots += block.rays[n];
        with_cell += parts.has_hidden(lumels[n]) ? block.rays[n] : 0;
    }
    if (block.ends.size() != slots || block.from.size() != with_cell)
        return false;
    const auto is_known = [&](LinkEnd end) { return end.number() < numbers.count(); };
    std::size_t next_slot = 0, near = 0;
    for (const NearLink& one : block.near) {
        if (one.slot < next_slot || one.slot >= slots || !is_known(one.end) ||
            one.end.number() == LinkNumbers::kNear ||
            block.ends[one.slot].number() != LinkNumbers::kNear)
            return false;
        next_slot = std::size_t(one.slot) + 1;
    }
    for (const LinkEnd end : block.ends)
        near += end.number() == LinkNumbers::kNear ? 1 : 0;
    return near == block.near.size() && near == block.near_light.size() &&
           fits(block.shares, near, numbers, lamps) &&
           (block.bins.size() == slots || (block.bins.empty() && !has_bins)) &&
           (block.weights.empty() || block.weights.size() == slots) &&
           std::ranges::all_of(block.weights, [](float w) { return w > 0.0f && w < kMaxWeight; }) &&
           std::all_of(block.ends.begin(), block.ends.end(), is_known) &&
           std::all_of(block.from.begin(), block.from.end(),
                       [](std::uint8_t cell) { return cell <= kNoCell; });
}

}  // namespace

LinkNumbers::LinkNumbers(std::size_t instances, std::size_t parts)
    : first_part_(std::uint32_t(kFirst + 2 * instances)),
      count_(std::uint32_t(first_part_ + parts))
{
    if (!fit(instances, parts))
        throw Error(ErrorKind::input, std::to_string(parts) + " lumels",
                    "are more than links can number; use a smaller --size");
}

std::size_t LinkTable::bytes() const
{
    std::size_t bytes = 0;
    for (const std::vector<LinkBlock>& blocks : rounds)
        for (const LinkBlock& block : blocks)
            bytes += block.rays.size() * sizeof(std::uint16_t) +
                     block.ends.size() * sizeof(LinkEnd) + block.from.size() + block.bins.size() +
                     block.weights.size() * sizeof(float) +
                     block.near.size() * (sizeof(NearLink) + sizeof(NearLight)) +
                     block.shares.size() * sizeof(NearShare);
    return bytes;
}

bool LinkTable::fits(const LinkWork& work, const SubLumels& parts, const LinkNumbers& numbers,
                     std::size_t traced, std::size_t lamps, bool has_bins) const
{
    for (std::size_t r = 0; r < rounds.size(); ++r) {
        if (rounds[r].size() != blocks_of(work))
            return false;
        for (std::size_t b = 0; b < rounds[r].size(); ++b) {
            const bool is_traced = r + 1 < rounds.size() || b < traced;
            const auto lumels = is_traced && is_own(work.ranks, b)
                                    ? lumels_of(work, b)
                                    : std::span<const std::uint32_t>();
            if (!lumel::fits(rounds[r][b], lumels, parts, numbers, lamps, has_bins))
                return false;
        }
    }
    return sky.size() == parts.count();
}

}  // namespace lumel
