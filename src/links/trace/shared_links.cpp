// LinkRadiosity by several ranks: each keeps the links of its blocks.

#include "base/core/fingerprint.h"
#include "links/kept/link_rows.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Blocks that each rank gives the first at once.
constexpr std::size_t kBlocksPerGather = 64;

/// Calls visit(b, block) for all blocks of a round, in order. Those of other ranks are there for
/// this call only, and on the first rank only; the others visit empty ones.
template <class Visit>
void visit_all(Ranks* ranks, std::vector<LinkBlock>& round, const Visit& visit)
{
    const std::size_t step = count_of(ranks) * kBlocksPerGather;
    for (std::size_t first = 0; first < round.size(); first += step) {
        const std::size_t last = std::min(first + step, round.size());
        std::vector<LinkBlock> others(last - first);
        share_blocks(ranks, first, last,
                     {.write = [&](StateWriter& writer, std::size_t b) { writer(round[b]); },
                      .read =
                          [&](StateReader& reader, std::size_t b) {
                              if (ranks->is_first())
                                  reader(others[b - first]);
                          }});
        for (std::size_t b = first; b < last; ++b)
            visit(b, is_own(ranks, b) ? round[b] : others[b - first]);
    }
}

}  // namespace

/// Gives each rank the light of the sky that the others have found for sub-lumels of these blocks.
void LinkRadiosity::share_sky(std::size_t first, std::size_t last)
{
    for (std::optional<LinkTable>& links : links_)
        share_bytes(work_.ranks, first, last, [&](std::size_t b) {
            const PartRange parts = parts_of(work_, *parts_, b);
            return std::as_writable_bytes(
                std::span(links->sky).subspan(parts.first, parts.last - parts.first));
        });
}

void LinkRadiosity::gather_links()
{
    if (count_of(work_.ranks) == 1)
        return;
    for (std::optional<LinkTable>& links : links_)
        for (std::vector<LinkBlock>& round : links->rounds)
            visit_all(work_.ranks, round, [&](std::size_t b, LinkBlock& block) {
                if (!is_own(work_.ranks, b))
                    round[b] = std::move(block);
            });
}

void LinkRadiosity::links_state(StateWriter& writer, LinkTable& links)
{
    writer(std::uint64_t(links.rounds.size()));
    for (std::vector<LinkBlock>& round : links.rounds) {
        writer(std::uint64_t(round.size()));
        visit_all(work_.ranks, round, [&](std::size_t, LinkBlock& block) { writer(block); });
    }
    writer(links.sky);
}

void LinkRadiosity::links_state(StateReader& reader, LinkTable& links)
{
    std::uint64_t rounds = 0, blocks = 0;
    reader(rounds);
    links.rounds.clear();
    for (std::uint64_t r = 0; r < rounds; ++r) {
        reader(blocks);
        if (blocks != tracer_->blocks())
            reader.fail();
        std::vector<LinkBlock>& round = links.rounds.emplace_back(blocks);
        for (std::size_t b = 0; b < round.size(); ++b) {
            LinkBlock block;
            reader(block);
            if (is_own(work_.ranks, b))
                round[b] = std::move(block);
        }
    }
    reader(links.sky);
}

/// Throws Error{input} on all ranks unless they would trace the same rays: they repeat the work
/// that they do not share, which processors of two kinds may round differently.
void LinkRadiosity::check_agreement() const
{
    if (count_of(work_.ranks) == 1)
        return;
    Fingerprint hash;
    for (const std::vector<std::uint16_t>& rays : rays_)
        hash.add(rays);
    hash.add(guide_.group);
    work_.ranks->agree(hash.value(), "has other intermediate results than rank 0; all machines "
                                     "need processors of the same kind");
}

}  // namespace lumel
