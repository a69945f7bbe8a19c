// LinkTracer's weights of rays, after each round anew.

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "base/core/frame.h"
#include "base/core/pi.h"
#include "base/core/sphere.h"
#include "links/kept/link_rows.h"
#include "links/rays/tracer.h"

namespace lumel {

void LinkTracer::weigh(const RayGuide& guide, std::uint32_t solution, LinkTable& links) const
{
    parallel_for_own(work_.ranks, 0, blocks(), kRowBlocksPerTask,
                     [&](std::size_t first, std::size_t last) {
                         for (std::size_t b = first; b < last; ++b)
                             weigh_block(b, guide, solution, links);
                     });
}

/// Weighs the rays of a block's guided lumels, and sums the light of the sky along them anew.
void LinkTracer::weigh_block(std::size_t b, const RayGuide& guide, std::uint32_t solution,
                             LinkTable& links) const
{
    const std::span<const std::uint32_t> lumels = lumels_of(work_, b);
    if (std::ranges::all_of(lumels, [&](std::uint32_t i) { return guide.group[i] == 0; }))
        return;
    std::vector<LinkRows> rounds;
    for (std::vector<LinkBlock>& round : links.rounds) {
        round[b].weights.assign(round[b].ends.size(), 1.0f);
        rounds.emplace_back(round[b]);
    }
    std::vector<LinkRow> rows(rounds.size());
    for (const std::uint32_t i : lumels) {
        std::ranges::transform(rounds, rows.begin(),
                               [&](LinkRows& round) { return round.next(parts_.has_hidden(i)); });
        if (guide.group[i] == 0)
            continue;
        const RayGuide::Probabilities& probabilities = guide.of(i, solution).probabilities;
        const auto uniform = float(rows.front().ends.size());
        float all = 0.0f;
        for (const LinkRow& row : rows)
            all += float(row.ends.size());
        for (std::size_t r = 0; r < rows.size(); ++r) {
            LinkBlock& block = links.rounds[r][b];
            const std::size_t first = rows[r].first_slot, last = first + rows[r].ends.size();
            for (std::size_t slot = first; slot < last; ++slot)
                block.weights[slot] =
                    RayGuide::weight(probabilities[block.bins[slot]], uniform, all);
        }
        sum_sky(i, rows, guide, solution, links.sky);
    }
}

/// Sums the light of the sky along the rays of a lumel. rows: of all rounds.
void LinkTracer::sum_sky(std::uint32_t i, std::span<const LinkRow> rows, const RayGuide& guide,
                         std::uint32_t solution, std::vector<glm::vec3>& sky) const
{
    std::fill(sky.begin() + parts_.first(i), sky.begin() + parts_.end(i), glm::vec3(0.0f));
    std::optional<GuidedDraw> draw;
    for (std::uint32_t r = 0; r < rows.size(); ++r) {
        const LumelSamples own = samples_of(i, r, solution, rows[r].ends.size());
        for (std::uint32_t k = 0; k < rows[r].ends.size(); ++k)
            if (rows[r].ends[k].number() == LinkNumbers::kSky) {
                if (!draw)
                    draw.emplace(guide.of(i, solution).probabilities);
                const RayOrigin start = work_.starts.start(i, own[k].stratified(kOriginPair));
                const glm::vec2 at = own[k].stratified(kLinkDirectionPair);
                const glm::vec3 direction =
                    frame_about(start.normal) * by_cosine(r > 0 ? (*draw)(at).point : at);
                sky[parts_.first(i) + rows[r].leaves(parts_, i, k)] +=
                    rows[r].weight(k) * kPi * work_.sources.dim_sky(direction);
            }
    }
}

}  // namespace lumel
