#include "links/live/filter_tile.h"

#include <algorithm>
#include <cmath>

#include <glm/glm.hpp>

namespace lumel {
namespace {

/// Standard deviation of the kernel [lumels].
constexpr float kSpread = 1.5f;
/// Radius of the patches that are compared, in lumels.
constexpr int kPatch = 1;
static_assert(kNearReach + kPatch <= kHalo);
/// Radius over which the variance is averaged, in lumels: weights are nearly independent of the
/// lumel's own variance.
constexpr int kNoiseReach = 3;
static_assert(kNoiseReach <= kHalo);
constexpr float kMinVariance = 1e-30f;
/// Normals of mixed lumels differ by less than 25 degrees.
const float kCosAlike = std::cos(glm::radians(25.0f));
/// Maximum distance from the other lumel's plane, in sizes, and maximum ratio of sizes.
constexpr float kOutOfPlane = 0.5f, kSizes = 2.0f;
/// Side of the square of texels that a pair of patches covers, in texels.
constexpr int kPairs = kTile + 2 * kPatch;

using Row = std::array<float, kTile>;

constexpr std::ptrdiff_t in_tile(Offset to)
{
    return std::ptrdiff_t(to.y) * kWide + to.x;
}

/// Path to a lumel within the radius: a last step from a lumel of the previous ring.
struct Way {
    Offset to;
    std::size_t from;        ///< index of the previous path
    unsigned step;           ///< index into kSteps
    std::ptrdiff_t step_at;  ///< offset to the lumel that has the last step's bit
    float bell;
};

constexpr int sign(int x)
{
    return (x > 0) - (x < 0);
}

Way way_to(Offset to, const std::vector<Way>& nearer)
{
    const int ring = std::max(std::abs(to.x), std::abs(to.y));
    const Offset last{std::abs(to.x) == ring ? sign(to.x) : 0,
                      std::abs(to.y) == ring ? sign(to.y) : 0};
    const Offset before{to.x - last.x, to.y - last.y};
    const auto from = std::find_if(nearer.begin(), nearer.end(), [&](const Way& way) {
        return way.to.x == before.x && way.to.y == before.y;
    });
    const auto is = [](Offset step, int x, int y) { return step.x == x && step.y == y; };
    const auto step = std::find_if(kSteps.begin(), kSteps.end(), [&](Offset s) {
        return is(s, last.x, last.y) || is(s, -last.x, -last.y);
    });
    Way way{to, std::size_t(from - nearer.begin()), unsigned(step - kSteps.begin()),
            in_tile(is(*step, last.x, last.y) ? before : to),
            std::exp(-0.5f * float(to.x * to.x + to.y * to.y) / (kSpread * kSpread))};
    return way;
}

/// Paths to all lumels within the radius, nearest first; the first is the lumel itself.
std::vector<Way> all_ways()
{
    std::vector<Way> ways = {{{0, 0}, 0, 0, 0, 1.0f}};
    for (int ring = 1; ring <= kNearReach; ++ring)
        for (int y = -ring; y <= ring; ++y)
            for (int x = -ring; x <= ring; ++x)
                if (std::max(std::abs(x), std::abs(y)) == ring)
                    ways.push_back(way_to({x, y}, ways));
    return ways;
}

const std::vector<Way>& ways()
{
    static const std::vector<Way> kWays = all_ways();
    return kWays;
}

/// For each lumel within a tile: 1 if a path of steps leads to the lumel at an offset.
using Reached = std::array<std::uint8_t, std::size_t(kTile) * kTile>;

/// Extends paths by a step. Returns false if it reaches no lumel.
bool take_step(const FilterTile& tile, const Way& way, const Reached& before, Reached& reached)
{
    unsigned any = 0;
    for (int y = 0; y < kTile; ++y) {
        const std::uint8_t* steps = &tile.steps[wide_at(0, y) + std::size_t(way.step_at)];
        const std::size_t row = std::size_t(y) * kTile;
        for (std::size_t x = 0; x < kTile; ++x) {
            reached[row + x] = std::uint8_t(before[row + x] & (steps[x] >> way.step));
            any |= reached[row + x];
        }
    }
    return any != 0;
}

// Simple loops over rows, without branches or selected references, so that compilers vectorise
// them.

glm::vec3 vector(const std::array<FilterTile::Wide<float>, 3>& planes, std::size_t t)
{
    return {planes[0][t], planes[1][t], planes[2][t]};
}

float least(float a, float b)
{
    return a < b ? a : b;
}

float most(float a, float b)
{
    return a < b ? b : a;
}

/// Lumels that mix with those at an offset: 1 or 0.
using Alike = Inner;

/// Returns false if no lumel mixes.
bool find_alike(const FilterTile& tile, Offset to, const Reached& reached, Alike& alike)
{
    float any = 0.0f;
    for (int y = 0; y < kTile; ++y) {
        const std::size_t a = wide_at(0, y), b = a + std::size_t(in_tile(to)),
                          row = std::size_t(y) * kTile;
        for (std::size_t x = 0; x < kTile; ++x) {
            const glm::vec3 normal = vector(tile.normal, a + x);
            const float cosine = glm::dot(normal, vector(tile.normal, b + x));
            const glm::vec3 apart = vector(tile.centre, b + x) - vector(tile.centre, a + x);
            const float off = glm::dot(normal, apart);
            const float own = tile.size[a + x], theirs = tile.size[b + x];
            const bool is = (cosine >= kCosAlike) & (std::abs(off) <= kOutOfPlane * own) &
                            (own <= kSizes * theirs) & (theirs <= kSizes * own);
            alike[row + x] = (is ? 1.0f : 0.0f) * float(reached[row + x] & 1);
        }
        for (std::size_t x = 0; x < kTile; ++x)
            any += alike[row + x];
    }
    return any > 0.0f;
}

/// Squared differences of a guide, and its noise, for each pair of texels at an offset.
struct Differences {
    std::array<float, std::size_t(kPairs) * kPairs> square, noise;
};

void find_differences(const FilterTile& tile, std::uint32_t k, Offset to, Differences& found)
{
    const FilterTile::Light& light = tile.light[k];
    const FilterTile::Wide<float>& variance = tile.variance[k];
    for (int y = 0; y < kPairs; ++y) {
        const std::size_t a = wide_at(-kPatch, y - kPatch), b = a + std::size_t(in_tile(to));
        float *square = &found.square[std::size_t(y) * kPairs],
              *noise = &found.noise[std::size_t(y) * kPairs];
        for (std::size_t x = 0; x < kPairs; ++x) {
            const glm::vec3 d = vector(light, a + x) - vector(light, b + x);
            const float same = tile.chart[a + x] == tile.chart[b + x] ? 1.0f : 0.0f;
            square[x] = same * glm::dot(d, d);
            noise[x] = same * (variance[a + x] + variance[b + x]);
        }
    }
}

/// Approximates exp(-x) from x = 0 to 4, and is 0 beyond.
float falling(float x)
{
    const float left = 1.0f - 0.25f * least(most(x, 0.0f), 4.0f), square = left * left;
    return square * square;
}

/// Weights of a row of lumels, from differences of the guide around the two beyond its noise.
void find_weights(const FilterTile& tile, std::uint32_t k, Offset to, const Differences& found,
                  int y, Row& weight)
{
    Row squares{}, noises{};
    const std::size_t own_at = wide_at(0, y), their_at = own_at + std::size_t(in_tile(to));
    for (int dy = -kPatch; dy <= kPatch; ++dy)
        for (int dx = -kPatch; dx <= kPatch; ++dx) {
            const std::size_t at = wide_at(dx, y + dy),
                              pair =
                                  std::size_t(y + dy + kPatch) * kPairs + std::size_t(dx + kPatch);
            for (std::size_t x = 0; x < kTile; ++x) {
                const float same = tile.chart[at + x] == tile.chart[own_at + x] ? 1.0f : 0.0f;
                squares[x] += same * found.square[pair + x];
                noises[x] += same * found.noise[pair + x];
            }
        }
    Row beyond;
    for (std::size_t x = 0; x < kTile; ++x) {
        const float own = tile.variance[k][own_at + x], theirs = tile.variance[k][their_at + x];
        const float expected =
            noises[x] * (own + least(own, theirs)) / (own + theirs + kMinVariance);
        beyond[x] = (squares[x] - expected) / (noises[x] + kMinVariance);
    }
    for (std::size_t x = 0; x < kTile; ++x)
        weight[x] = falling(beyond[x]);
}

}  // namespace

void find_variance(const FilterTile& tile, std::uint32_t k, Inner& variance)
{
    const FilterTile::Light &one = tile.light[(k + 1) % kSolutions],
                            &other = tile.light[(k + 2) % kSolutions];
    FilterTile::Wide<float> square{};
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t t = 0; t < square.size(); ++t) {
            const float d = one[c][t] - other[c][t];
            square[t] += 0.5f * d * d;
        }
    for (int y = 0; y < kTile; ++y) {
        Row sum{}, count{};
        const std::int32_t* own = &tile.chart[wide_at(0, y)];
        for (int dy = -kNoiseReach; dy <= kNoiseReach; ++dy)
            for (int dx = -kNoiseReach; dx <= kNoiseReach; ++dx) {
                const std::size_t at = wide_at(dx, y + dy);
                for (std::size_t x = 0; x < kTile; ++x) {
                    const float same = tile.chart[at + x] == own[x] ? 1.0f : 0.0f;
                    sum[x] += same * square[at + x];
                    count[x] += same;
                }
            }
        for (std::size_t x = 0; x < kTile; ++x)
            variance[std::size_t(y) * kTile + x] = sum[x] / count[x];
    }
}

void weigh_tile(const FilterTile& tile, std::uint32_t k, NearWeights& weights)
{
    for (std::size_t n = 0; n < kNearWays; ++n) {
        weights.to[n] = ways()[n + 1].to;
        weights.weight[n].fill(0.0f);
    }
    std::vector<Reached> reached(ways().size());
    std::vector<char> any(ways().size(), 1);
    reached[0].fill(1);
    Differences found;
    Alike alike;
    for (std::size_t w = 1; w < ways().size(); ++w) {
        const Way& way = ways()[w];
        any[w] = any[way.from] && take_step(tile, way, reached[way.from], reached[w]);
        if (!any[w] || !find_alike(tile, way.to, reached[w], alike))
            continue;
        find_differences(tile, k, way.to, found);
        for (int y = 0; y < kTile; ++y) {
            Row look_alike;
            find_weights(tile, k, way.to, found, y, look_alike);
            const std::size_t row = std::size_t(y) * kTile;
            for (std::size_t x = 0; x < kTile; ++x)
                weights.weight[w - 1][row + x] = way.bell * alike[row + x] * look_alike[x];
        }
    }
}

}  // namespace lumel
