// LinkRadiosity by several ranks: each traces its blocks of links, and has all of them afterwards.

#include "base/core/fingerprint.h"
#include "base/ranks/rank_blocks.h"
#include "links/trace/links.h"

namespace lumel {

/// Gives each rank the blocks of the round that the others have traced.
void LinkRadiosity::share_links(std::size_t first, std::size_t last)
{
    share_blocks(work_.ranks, first, last, [&](auto& archive, std::size_t b) {
        const std::size_t end = std::min((b + 1) * kLinkBlock, work_.order.size());
        for (std::optional<LinkTable>& links : links_) {
            archive(links->rounds.back()[b]);
            for (std::size_t o = b * kLinkBlock; o < end; ++o) {
                const std::uint32_t i = work_.order[o];
                for (std::uint32_t p = parts_->first(i); p < parts_->end(i); ++p)
                    archive(links->sky[p]);
            }
        }
    });
}

/// Throws Error{input} on all ranks unless they would trace the same rays: they repeat the work
/// that they do not share, which processors of two kinds may round differently.
void LinkRadiosity::check_agreement() const
{
    if (count_of(work_.ranks) == 1)
        return;
    Fingerprint hash;
    hash.add(rays_);
    hash.add(guide_.group);
    work_.ranks->agree(hash.value(), "has other intermediate results than rank 0; all machines "
                                     "need processors of the same kind");
}

}  // namespace lumel
