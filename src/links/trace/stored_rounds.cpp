// LinkRadiosity over links of an earlier run: rounds traced again, and stored.

#include <algorithm>
#include <cmath>

#include "links/trace/links.h"

namespace lumel {

void LinkRadiosity::use(const StoredLinks& links, Then then)
{
    stored_ = &links;
    then_ = then;
}

void LinkRadiosity::relight()
{
    work_.sources.find();
    if (stage_ == Stage::begin)
        return;
    if (means_.size() != (stored_ ? stored_->rounds.size() : 0))
        filter_.reset();
    find_light();
    received_ = {};
    sources_ = {};
    mean_ = {};
    direct_mean_ = {};
    adapted_.clear();
    round_ = 0;
    means_.clear();
    passes_.clear();
    refined_ = {};
    guide_ = {};
    state_ = {};
    stage_ = Stage::direct;
}

bool LinkRadiosity::has_known_round() const
{
    return stored_ && round_ < stored_->rounds.size();
}

/// Starts a round of an earlier run again. Lumels that changed have the mean number of rays if they
/// were buried. A guide of another atlas guides no lumel of this one.
void LinkRadiosity::begin_known_round()
{
    const StoredLinks::Round& round = stored_->rounds[round_];
    mean_rays_ = round.mean;
    rays_ = round.rays;
    for (std::size_t k = 0; k < kSolutions; ++k) {
        rays_[k].resize(work_.order.size(), 0);
        for (std::size_t i = 0; i < rays_[k].size(); ++i)
            if (rays_[k][i] == 0 && (changes_.all || changes_.starts[i]))
                rays_[k][i] = std::uint16_t(std::lround(mean_rays_));
        first_rays_[k] = first_rays(round.rays[k]);
    }
    refined_ = {};
    if (round_ == 0 && !shares_directions() && stored_->guide.fits(work_.order.size()))
        guide_ = stored_->guide;
    begin_links();
}

StoredLinks LinkRadiosity::kept(const std::string& hash) const
{
    StoredLinks kept{.scene_hash = hash,
                     .seed = options_.seed,
                     .shared_directions = std::uint8_t(shares_directions()),
                     .ray_offset = work_.scene.rays.ray_offset(),
                     .lumels = lumel_hashes(work_.world, work_.scene.lumels),
                     .instances = instance_hashes(work_.scene.scene),
                     .boxes = instance_boxes(work_.scene.scene),
                     .guide = guide_,
                     .passes = passes_};
    for (std::size_t r = 0; r < means_.size(); ++r)
        kept.rounds.push_back(stored_round(r, kept.numbers()));
    // A limit of rays can end a bake when a pass has just been scheduled.
    if (!kept.passes.empty() && direct_->fraction() < 1.0)
        kept.passes.pop_back();
    keep_places(work_.scene.atlas, kept);
    return kept;
}

/// A round by lumel, with numbers of lumels in place of those of sub-lumels.
StoredLinks::Round LinkRadiosity::stored_round(std::size_t r, const LinkNumbers& stored) const
{
    const std::vector<std::uint32_t>& order = work_.order;
    StoredLinks::Round round{.mean = means_[r]};
    const auto as_stored = [&](LinkEnd end) {
        return numbers_->is_part(end.number())
                   ? LinkEnd::of(stored.of_part(parts_->lumel(numbers_->part(end.number()))),
                                 end.cell())
                   : end;
    };
    for (std::uint32_t k = 0; k < kSolutions; ++k) {
        round.rays[k].resize(order.size());
        for (std::size_t o = 0; o < order.size(); ++o)
            round.rays[k][order[o]] = links_[k]->rounds[r][o / kLinkBlock].rays[o % kLinkBlock];
        const std::vector<std::size_t> first = first_rays(round.rays[k]);
        round.ends[k].resize(first.back());
        std::vector<LinkEnd>::const_iterator end;
        for (std::size_t o = 0; o < order.size(); ++o) {
            if (o % kLinkBlock == 0)
                end = links_[k]->rounds[r][o / kLinkBlock].ends.begin();
            for (std::size_t n = first[order[o]]; n < first[order[o] + 1]; ++n)
                round.ends[k][n] = as_stored(*end++);
        }
    }
    return round;
}

std::uint64_t LinkRadiosity::traced() const
{
    std::uint64_t rays = 0;
    for_each_block([&](const LinkBlock& block) { rays += block.traced; });
    return rays;
}

std::uint64_t LinkRadiosity::sent() const
{
    std::uint64_t rays = 0;
    for_each_block([&](const LinkBlock& block) { rays += block.ends.size(); });
    return rays;
}

template <class Visit>
void LinkRadiosity::for_each_block(const Visit& visit) const
{
    for (const std::optional<LinkTable>& links : links_)
        if (links)
            for (const std::vector<LinkBlock>& round : links->rounds)
                for (const LinkBlock& block : round)
                    visit(block);
}

}  // namespace lumel
