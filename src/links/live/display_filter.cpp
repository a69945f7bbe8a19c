#include "links/live/display_filter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "atlas/lumels/sides.h"
#include "base/core/luminance.h"
#include "base/core/parallel.h"
#include "links/live/filter_tile.h"

namespace lumel {
namespace {

/// Lumels and tiles per piece of work: a few milliseconds.
constexpr std::size_t kLumelsAtOnce = 8192, kTilesAtOnce = 4;
/// Lumels per task.
constexpr std::size_t kShownPerTask = 256;

/// Irradiance gathered by rays [lx].
glm::vec3 by_rays(const LumelSweeps& sweeps, std::span<const glm::vec3> sky, std::size_t lumel)
{
    return sweeps.received(lumel) + (sky.empty() ? glm::vec3(0.0f) : sky[lumel]);
}

}  // namespace

DisplayFilter::DisplayFilter(const LinkContext& place, const LumelLinks& links)
    : place_(place),
      links_(links),
      by_side_(lumels_by_side(place.scene.lumels)),
      places_(place.lumels().size()),
      noise_left_(places_.size(), 1.0f)
{
    const auto across = std::uint32_t((place.scene.lumels.width + kTile - 1) / kTile),
               down = std::uint32_t((place.scene.lumels.height + kTile - 1) / kTile);
    std::vector<char> used(std::size_t(across) * down * 2, 0);
    const auto tile_of = [&](const Lumel& lumel) {
        const std::uint32_t width = std::uint32_t(place.scene.lumels.width);
        const std::uint32_t x = lumel.texel % width / kTile, y = lumel.texel / width / kTile;
        return 2 * (y * across + x) + (is_back(lumel) ? 1 : 0);
    };
    for (const Lumel& lumel : place.lumels())
        used[tile_of(lumel)] = 1;
    for (std::uint32_t t = 0; t < used.size(); ++t)
        if (used[t])
            tiles_.push_back({.left = int(t / 2 % across) * kTile,
                              .top = int(t / 2 / across) * kTile,
                              .side = int(t % 2)});
}

void DisplayFilter::begin(const LumelSweeps& sweeps, const glm::vec3& sky)
{
    const std::size_t count = places_.size();
    sweeps_ = &sweeps;
    sky_ = sky;
    stage_ = Stage::halves;
    next_ = 0;
    halves_.fill(std::vector<glm::vec3>(count, glm::vec3(0.0f)));
    nearest_.assign(count, 0.0f);
    noise_.assign(count, 0.0f);
    steps_.assign(count, 0);
}

bool DisplayFilter::step()
{
    const auto do_lumels = [&](const auto& work) {
        const std::size_t first = next_, last = std::min(first + kLumelsAtOnce, places_.size());
        parallel_for(last - first, kShownPerTask, [&](std::size_t from, std::size_t to) {
            for (std::size_t i = first + from; i < first + to; ++i)
                work(i);
        });
        next_ = last;
        return last == places_.size();
    };
    bool ended = true;
    if (stage_ == Stage::halves)
        ended = do_lumels([&](std::size_t i) { find_halves(i); });
    else if (stage_ == Stage::nearest)
        ended = do_lumels([&](std::size_t i) { find_nearest(i); });
    else if (stage_ == Stage::steps)
        ended = do_lumels([&](std::size_t i) { steps_[i] = steps_of(i); });
    else if (stage_ == Stage::noise)
        ended = do_tiles([&](Tile&, FilterTile& tile) { find_noise(tile); });
    else if (stage_ == Stage::weights)
        ended = do_tiles([&](Tile& of, FilterTile& tile) { weigh(of, tile); });
    if (ended && stage_ != Stage::done) {
        stage_ = Stage(int(stage_) + 1);
        next_ = 0;
    }
    if (stage_ != Stage::done)
        return false;
    halves_ = {};
    nearest_ = noise_ = {};
    steps_ = {};
    return true;
}

template <class Work>
bool DisplayFilter::do_tiles(const Work& work)
{
    const std::size_t first = next_, last = std::min(first + kTilesAtOnce, tiles_.size());
    parallel_for(last - first, 1, [&](std::size_t from, std::size_t to) {
        const auto tile = std::make_unique<FilterTile>();
        for (std::size_t t = first + from; t < first + to; ++t) {
            fill(tiles_[t], *tile);
            work(tiles_[t], *tile);
        }
    });
    next_ = last;
    return last == tiles_.size();
}

/// Irradiance by the rays of each checkerboard half, scaled as if they were all rays.
void DisplayFilter::find_halves(std::size_t i)
{
    const std::span<const std::uint32_t> links = links_.of(i);
    glm::vec4 sums[2] = {glm::vec4(0.0f), glm::vec4(0.0f)};
    for (std::uint32_t k = 0; k < links.size(); ++k)
        sums[links_.half_of(k)] += sweeps_->sent(links[k]);
    const float share = 2.0f / float(links.size());
    const glm::vec3 sky = links_.sky_light()[i], white = links_.white_sky_light()[i];
    halves_[0][i] = share * glm::vec3(sums[0]) + sky_ * 2.0f * white;
    halves_[1][i] = share * glm::vec3(sums[1]) + sky_ * 2.0f * (sky - white);
}

/// Lower bound on the lengths of a lumel's rays [m].
void DisplayFilter::find_nearest(std::size_t i)
{
    const glm::vec3& centre = place_.world[i].centre;
    float nearest = std::numeric_limits<float>::max();
    for (const std::uint32_t link : links_.of(i))
        if (link < links_.sky())
            nearest = std::min(nearest, glm::distance(centre, place_.world[link].centre) -
                                            place_.world[link].size);
    nearest_[i] = std::max(nearest, 0.0f);
}

/// Bits of the neighbours on the same chart and side across which the filter may step.
std::uint8_t DisplayFilter::steps_of(std::size_t i) const
{
    const Lumel& lumel = place_.lumels()[i];
    if (lumel.flags & kLumelBuried)
        return 0;
    const int width = place_.scene.lumels.width, x = int(lumel.texel) % width,
              y = int(lumel.texel) / width;
    unsigned steps = 0;
    for (unsigned s = 0; s < kSteps.size(); ++s) {
        const std::uint32_t j = lit_lumel_at(place_.scene.lumels, by_side_, x + kSteps[s].x,
                                             y + kSteps[s].y, is_back(lumel) ? 1 : 0);
        if (j != kNoLumel && place_.lumels()[j].chart == lumel.chart && may_step(i, j))
            steps |= 1u << s;
    }
    return std::uint8_t(steps);
}

/// True if no geometry separates two neighbours.
bool DisplayFilter::may_step(std::size_t i, std::size_t j) const
{
    const WorldLumel &a = place_.world[i], &b = place_.world[j];
    if (std::min(nearest_[i], nearest_[j]) > kMayStandBetween * glm::distance(a.centre, b.centre))
        return true;
    const float ray_offset = std::max(kLift * std::max(a.size, b.size), place_.rays.ray_offset());
    return place_.rays.is_clear(ray_between(a.centre + ray_offset * a.normal,
                                            b.centre + ray_offset * b.normal, 0.0f,
                                            std::uint32_t(i)));
}

/// Solution 0 is the guide, the mean of the cross-filtered solutions 1 and 2, which are the halves.
void DisplayFilter::fill(const Tile& of, FilterTile& tile) const
{
    for (int y = -kHalo; y < kTile + kHalo; ++y)
        for (int x = -kHalo; x < kTile + kHalo; ++x) {
            const std::size_t t = wide_at(x, y);
            const std::uint32_t i = tile.lumel[t] =
                lit_lumel_at(place_.scene.lumels, by_side_, of.left + x, of.top + y, of.side);
            const bool is = i != kNoLumel;
            tile.chart[t] = is ? std::int32_t(place_.lumels()[i].chart) : -1;
            tile.steps[t] = is ? steps_[i] : std::uint8_t(0);
            tile.size[t] = is ? place_.world[i].size : 0.0f;
            tile.variance[0][t] = is ? noise_[i] : 0.0f;
            for (int c = 0; c < 3; ++c) {
                const auto axis = std::size_t(c);
                tile.centre[axis][t] = is ? place_.world[i].centre[c] : 0.0f;
                tile.normal[axis][t] = is ? place_.world[i].normal[c] : 0.0f;
                const float one = is ? halves_[0][i][c] : 0.0f,
                            other = is ? halves_[1][i][c] : 0.0f;
                tile.light[0][axis][t] = 0.5f * (one + other);
                tile.light[1][axis][t] = one;
                tile.light[2][axis][t] = other;
            }
        }
}

/// The mean of two halves has half the variance of one.
void DisplayFilter::find_noise(FilterTile& tile)
{
    Inner inner;
    find_variance(tile, 0, inner);
    for_each_lumel(
        tile, [&](std::uint32_t i, std::size_t t, std::size_t) { noise_[i] = 0.5f * inner[t]; });
}

void DisplayFilter::weigh(Tile& of, FilterTile& tile)
{
    const auto weights = std::make_unique<NearWeights>();
    weigh_tile(tile, 0, *weights);
    of.first = {0};
    of.weights.clear();
    for_each_lumel(tile, [&](std::uint32_t i, std::size_t t, std::size_t at) {
        for (std::size_t n = 0; n < kNearWays; ++n)
            if (weights->weight[n][t] > 0.0f) {
                const std::ptrdiff_t there =
                    std::ptrdiff_t(at) + weights->to[n].y * kWide + weights->to[n].x;
                of.weights.push_back({tile.lumel[std::size_t(there)], weights->weight[n][t]});
            }
        places_[i] = {std::uint32_t(&of - tiles_.data()), std::uint32_t(of.first.size() - 1)};
        of.first.push_back(std::uint32_t(of.weights.size()));
        noise_left_[i] = noise_left(i, of);
    });
}

/// Noise is independent between lumels: the variance of Σ w x / Σ w is Σ w² σ² / (Σ w)². Ignores
/// the filter's bias.
float DisplayFilter::noise_left(std::uint32_t i, const Tile& of) const
{
    const auto light = [&](std::uint32_t j) { return 0.5f * (halves_[0][j] + halves_[1][j]); };
    glm::vec3 sum = light(i);
    float variance = noise_[i];
    const Place place = places_[i];
    for (std::uint32_t w = of.first[place.number]; w < of.first[place.number + 1]; ++w) {
        const Weight& one = of.weights[w];
        sum += one.weight * light(one.lumel);
        variance += one.weight * one.weight * noise_[one.lumel];
    }
    // The ratio of two weighted sums, so Σ w cancels. The variance is summed over three channels.
    constexpr float kOfColour = 3.0f;
    const float mean = sum_of(sum) / kOfColour;
    return mean > 0.0f ? std::sqrt(variance / kOfColour) / mean : 0.0f;
}

/// Requires weights.
glm::vec3 DisplayFilter::filtered(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                                  std::size_t i) const
{
    const Place place = places_[i];
    const Tile& tile = tiles_[place.tile];
    glm::vec3 sum = by_rays(sweeps, sky, i);
    float weights = 1.0f;
    for (std::uint32_t w = tile.first[place.number]; w < tile.first[place.number + 1]; ++w) {
        sum += tile.weights[w].weight * by_rays(sweeps, sky, tile.weights[w].lumel);
        weights += tile.weights[w].weight;
    }
    return sum / weights;
}

glm::vec3 DisplayFilter::irradiance(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                                    std::size_t i) const
{
    const glm::vec3 whole = sweeps.irradiance(i);
    if (places_[i].tile == ~0u)
        return whole;
    return glm::max(whole + (filtered(sweeps, sky, i) - by_rays(sweeps, sky, i)), glm::vec3(0.0f));
}

float DisplayFilter::noise(const LumelSweeps& sweeps, std::span<const glm::vec3> sky,
                           std::size_t i) const
{
    if (place_.is_buried(i))
        return 0.0f;
    if (places_[i].tile == ~0u)
        return 1.0f;
    const float all = sum_of(irradiance(sweeps, sky, i));
    return all > 0.0f ? noise_left_[i] * sum_of(filtered(sweeps, sky, i)) / all : 0.0f;
}

std::uint64_t DisplayFilter::bytes() const
{
    std::uint64_t bytes =
        places_.size() * (sizeof(Place) + sizeof(float)) + by_side_.size() * sizeof(std::uint32_t);
    for (const Tile& tile : tiles_)
        bytes += tile.first.size() * sizeof(std::uint32_t) + tile.weights.size() * sizeof(Weight);
    return bytes;
}

}  // namespace lumel
