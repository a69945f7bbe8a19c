#include "links/filter/filter.h"

#include <algorithm>
#include <memory>

#include "atlas/lumels/sides.h"
#include "base/core/parallel.h"
#include "links/filter/filter_tile.h"

namespace lumel {
namespace {

constexpr std::size_t kLumelsPerTask = 256;

glm::vec3 weighted(const std::array<Inner, 3>& sum, const Inner& weight, std::size_t t)
{
    return glm::vec3(sum[0][t], sum[1][t], sum[2][t]) / weight[t];
}

/// Adds lumel i: `one` and `other` are the filtered estimates a and b of the cross-filtered
/// solutions.
void take(const glm::vec3& a, const glm::vec3& b, const glm::vec3& one, const glm::vec3& other,
          std::uint32_t i, Mean& mean)
{
    constexpr float kShare = 1.0f / float(kSolutions);
    const glm::vec3 d = one - other;
    mean.light[i] += 0.5f * kShare * (one + other);
    // d² is twice the variance of one; the mean of all three pairs has a third of it.
    mean.noise[i] += kShare * glm::dot(d, d) / 6.0f;
    mean.wrong[i] += kShare * glm::dot(one - a, other - b);
}

}  // namespace

ChartFilter::ChartFilter(const LinkWork& work, const SubLumels& parts,
                         const std::vector<float>& nearest)
    : work_(work),
      parts_(parts),
      by_side_(lumels_by_side(work.scene.lumels)),
      nearest_(nearest),
      steps_(work.world.size())
{
    parallel_for(work.world.size(), kLumelsPerTask, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            steps_[i] = find_steps(i);
    });
}

std::uint64_t ChartFilter::bytes(std::size_t lumels, std::size_t texels)
{
    constexpr std::size_t kOfMean = sizeof(glm::vec3) + 2 * sizeof(float);
    return 2 * texels * sizeof(std::uint32_t) +
           lumels * (sizeof(std::uint8_t) + (kSolutions + 1) * sizeof(float) + kBells * kOfMean);
}

/// Bits of the neighbours on the same chart and side across which the filter may step.
std::uint8_t ChartFilter::find_steps(std::size_t i) const
{
    const Lumel& lumel = work_.lumels()[i];
    if ((lumel.flags & kLumelBuried) || parts_.is_cut(i))
        return 0;
    const int width = work_.scene.lumels.width, x = int(lumel.texel) % width,
              y = int(lumel.texel) / width, side = lumel.flags & kLumelBack ? 1 : 0;
    unsigned steps = 0;
    for (unsigned s = 0; s < kSteps.size(); ++s) {
        const std::uint32_t j =
            lit_lumel_at(work_.scene.lumels, by_side_, x + kSteps[s].x, y + kSteps[s].y, side);
        if (j != kNoLumel && work_.lumels()[j].chart == lumel.chart && !parts_.is_cut(j) &&
            may_step(i, j, std::min(nearest_[i], nearest_[j])))
            steps |= 1u << s;
    }
    return std::uint8_t(steps);
}

/// True if no geometry separates two neighbours. nearest: distance to the nearest geometry [m].
bool ChartFilter::may_step(std::size_t i, std::size_t j, float nearest) const
{
    const WorldLumel &a = work_.world[i], &b = work_.world[j];
    if (nearest > kMayStandBetween * glm::distance(a.centre, b.centre))
        return true;
    const float ray_offset =
        std::max(kLift * std::max(a.size, b.size), work_.scene.rays.ray_offset());
    return work_.scene.rays.sees(a.centre + ray_offset * a.normal, b.centre + ray_offset * b.normal,
                                 0.0f, std::uint32_t(i));
}

/// Fills the tile, except variances. Returns false if it has no lumels.
bool ChartFilter::fill(FilterTile& tile, int left, int top, int side, const Solutions& found) const
{
    bool any = false;
    for (int y = -kHalo; y < kTile + kHalo; ++y)
        for (int x = -kHalo; x < kTile + kHalo; ++x) {
            const std::size_t t = wide_at(x, y);
            const std::uint32_t i = tile.lumel[t] =
                lit_lumel_at(work_.scene.lumels, by_side_, left + x, top + y, side);
            const bool is = i != kNoLumel;
            any = any || (is && x >= 0 && x < kTile && y >= 0 && y < kTile);
            tile.chart[t] = is ? std::int32_t(work_.lumels()[i].chart) : -1;
            tile.steps[t] = is ? steps_[i] : std::uint8_t(0);
            tile.size[t] = is ? work_.world[i].size : 0.0f;
            tile.nearest[t] = is ? nearest_[i] : 0.0f;
            for (int c = 0; c < 3; ++c) {
                const auto axis = std::size_t(c);
                tile.centre[axis][t] = is ? work_.world[i].centre[c] : 0.0f;
                tile.normal[axis][t] = is ? work_.world[i].normal[c] : 0.0f;
                for (std::uint32_t k = 0; k < kSolutions; ++k)
                    tile.light[k][axis][t] = is ? found[k][i][c] : 0.0f;
            }
        }
    return any;
}

/// Calls visit(tile) for each tile with lumels, in parallel.
template <class Visit>
void ChartFilter::for_each_tile(const Solutions& found, const Visit& visit) const
{
    const std::size_t across = std::size_t((work_.scene.lumels.width + kTile - 1) / kTile),
                      down = std::size_t((work_.scene.lumels.height + kTile - 1) / kTile);
    parallel_for(2 * across * down, 1, [&](std::size_t first, std::size_t last) {
        const auto tile = std::make_unique<FilterTile>();
        for (std::size_t n = first; n < last; ++n) {
            const int left = int(n / 2 % across) * kTile, top = int(n / 2 / across) * kTile;
            if (fill(*tile, left, top, int(n % 2), found))
                visit(*tile);
        }
    });
}

std::vector<Mean> ChartFilter::filter(const Solutions& found) const
{
    std::array<std::vector<float>, kSolutions> variance;
    variance.fill(std::vector<float>(work_.world.size()));
    for_each_tile(found, [&](const FilterTile& tile) {
        Inner inner;
        for (std::uint32_t k = 0; k < kSolutions; ++k) {
            find_variance(tile, k, inner);
            for_each_lumel(tile, [&](std::uint32_t i, std::size_t t, std::size_t) {
                variance[k][i] = inner[t];
            });
        }
    });
    const std::vector<float> none(work_.world.size(), 0.0f);
    std::vector<Mean> result(kBells, {Estimates(work_.world.size(), glm::vec3(0.0f)), none, none});
    for_each_tile(found, [&](FilterTile& tile) {
        for (std::size_t t = 0; t < tile.lumel.size(); ++t)
            for (std::uint32_t k = 0; k < kSolutions; ++k)
                tile.variance[k][t] = tile.lumel[t] == kNoLumel ? 0.0f : variance[k][tile.lumel[t]];
        const auto filtered = std::make_unique<FilteredTiles>();
        filter_tile(tile, *filtered);
        for (std::size_t b = 0; b < kBells; ++b)
            for (std::uint32_t k = 0; k < kSolutions; ++k) {
                const FilteredTile& of = (*filtered)[b][k];
                const Estimates &one = found[(k + 1) % kSolutions],
                                &other = found[(k + 2) % kSolutions];
                for_each_lumel(tile, [&](std::uint32_t i, std::size_t t, std::size_t) {
                    take(one[i], other[i], weighted(of.one, of.weight, t),
                         weighted(of.other, of.weight, t), i, result[b]);
                });
            }
    });
    return result;
}

}  // namespace lumel
