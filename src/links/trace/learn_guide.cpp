// LinkRadiosity's guide: from where the first round's rays brought light to groups of neighbours.

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "base/core/frame.h"
#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "base/ranks/rank_blocks.h"
#include "links/trace/links.h"

namespace lumel {
namespace {

/// Lumels of a group: the most, and the least that have enough rays to learn from.
constexpr std::size_t kMaxGroup = 64, kMinGroup = 16;
/// Of cube_side().
constexpr std::size_t kCubeSides = 6;
/// Blocks of links per task.
constexpr std::size_t kGuideBlocksPerTask = 4;

/// Groups of `lumels` that face the same way, as indices into `lumels`. Those that face one way are
/// split evenly into groups of at most kMaxGroup.
std::vector<std::vector<std::size_t>> groups_of(const WorldLumels& world,
                                                std::span<const std::uint32_t> lumels)
{
    std::array<std::vector<std::size_t>, kCubeSides> facing;
    for (std::size_t n = 0; n < lumels.size(); ++n)
        facing[std::size_t(cube_side(world[lumels[n]].normal))].push_back(n);
    std::vector<std::vector<std::size_t>> groups;
    for (const std::vector<std::size_t>& all : facing) {
        const std::size_t parts = (all.size() + kMaxGroup - 1) / kMaxGroup;
        for (std::size_t part = 0; part < parts; ++part)
            groups.emplace_back(all.begin() + std::ptrdiff_t(all.size() * part / parts),
                                all.begin() + std::ptrdiff_t(all.size() * (part + 1) / parts));
    }
    std::erase_if(groups,
                  [](const std::vector<std::size_t>& one) { return one.size() < kMinGroup; });
    return groups;
}

}  // namespace

/// Luminous light that ends of links send [lm/m²].
struct LinkRadiosity::SentLight {
    std::vector<float> indirect, all;  ///< [numbers]
};

struct LinkRadiosity::LearntGroup {
    std::vector<std::uint32_t> lumels;
    RayGuide::Table table;

    template <class Archive>
    void state(Archive& archive)
    {
        archive(lumels, table);
    }
};

/// Whether the rays so far have bins: to learn from, or to be weighed.
bool LinkRadiosity::has_bins() const
{
    return !guide_.empty() || (can_guide_ && links_[0]->rounds.size() <= 1);
}

/// Light that ends of links send in a solution: the mean over the cells of a lumel, as what a guide
/// does not know costs noise, not light.
LinkRadiosity::SentLight LinkRadiosity::light_sent(std::size_t k) const
{
    SentLight sent{std::vector<float>(numbers_->count(), 0.0f),
                   std::vector<float>(numbers_->count(), 0.0f)};
    for (std::uint32_t p = 0; p < parts_->count(); ++p) {
        const std::uint32_t i = parts_->lumel(p), number = numbers_->of_part(p);
        const glm::vec3& albedo = work_.lumels()[i].albedo;
        sent.indirect[number] = float(luminance(albedo * received_[k][p]));
        sent.all[number] = sent.indirect[number] + float(luminance(albedo * direct_->mean(i)));
    }
    return sent;
}

/// Adds the rays of a lumel in the first round of a solution.
void LinkRadiosity::add_moments(std::uint32_t i, std::uint32_t k, const LinkRow& row,
                                const std::uint8_t* bins, const SentLight& sent,
                                GuideMoments& moments) const
{
    const LumelSamples own = tracer_->samples_of(i, 0, k, row.ends.size());
    const glm::mat3 frame = frame_about(work_.world[i].normal);
    std::size_t n_near = 0;
    for (std::uint32_t n = 0; n < row.ends.size(); ++n) {
        const std::uint32_t number = row.ends[n].number();
        double light = double(sent.all[number]);
        if (number == LinkNumbers::kNear) {
            const NearLink& near = row.near[n_near];
            light = luminance(row.near_light[n_near].light) +
                    luminance(near.weight()) * double(sent.indirect[near.end.number()]);
            ++n_near;
        } else if (number == LinkNumbers::kSky) {
            const glm::vec3 direction = frame * by_cosine(own[n].stratified(kLinkDirectionPair));
            light = luminance(glm::vec3(kPi * work_.sources.dim_sky(direction)));
        }
        moments.add(k, bins[n], light);
    }
}

/// Tables for the groups of a block that gain by one.
std::vector<LinkRadiosity::LearntGroup>
LinkRadiosity::learn_block(std::size_t b, const std::array<SentLight, kSolutions>& sent) const
{
    const std::size_t begin = b * kLinkBlock;
    const auto lumels =
        std::span(work_.order).subspan(begin, std::min(kLinkBlock, work_.order.size() - begin));
    std::array<std::vector<LinkRow>, kSolutions> rows;
    for (std::uint32_t k = 0; k < kSolutions; ++k) {
        LinkRows all(links_[k]->rounds.front()[b]);
        for (const std::uint32_t i : lumels)
            rows[k].push_back(all.next(parts_->has_hidden(i)));
    }
    std::vector<LearntGroup> learnt;
    for (const std::vector<std::size_t>& group : groups_of(work_.world, lumels)) {
        GuideMoments moments;
        std::vector<std::uint32_t> members;
        for (const std::size_t n : group) {
            members.push_back(lumels[n]);
            for (std::uint32_t k = 0; k < kSolutions; ++k)
                add_moments(lumels[n], k, rows[k][n],
                            links_[k]->rounds.front()[b].bins.data() + rows[k][n].first_slot,
                            sent[k], moments);
        }
        if (const std::optional<RayGuide::Table> table = moments.find())
            learnt.push_back({std::move(members), *table});
    }
    return learnt;
}

/// Learns from the first round, whose rays are uniform. Returns whether any group gains.
bool LinkRadiosity::learn_guide()
{
    if (!can_guide_)
        return false;
    std::array<SentLight, kSolutions> sent;
    for (std::size_t k = 0; k < kSolutions; ++k)
        sent[k] = light_sent(k);
    std::vector<std::vector<LearntGroup>> learnt(tracer_->blocks());
    parallel_for_own(work_.ranks, 0, learnt.size(), kGuideBlocksPerTask,
                     [&](std::size_t from, std::size_t to) {
                         for (std::size_t b = from; b < to; ++b)
                             learnt[b] = learn_block(b, sent);
                     });
    share_blocks(work_.ranks, 0, learnt.size(),
                 [&](auto& archive, std::size_t b) { archive(learnt[b]); });
    guide_ = {};
    for (const std::vector<LearntGroup>& block : learnt)
        for (const LearntGroup& group : block) {
            if (guide_.empty()) {
                guide_.group.assign(work_.order.size(), 0);
                guide_.tables.push_back(RayGuide::all_uniform());
            }
            for (const std::uint32_t i : group.lumels)
                guide_.group[i] = std::uint32_t(guide_.tables.size());
            guide_.tables.push_back(group.table);
        }
    return !guide_.empty();
}

}  // namespace lumel
