#include "links/filter.h"

#include <algorithm>
#include <cmath>

#include "core/parallel.h"

namespace lumel {
namespace {

/// Lumels to either side, and the deviation of the bell over them.
constexpr int kReach = 2;
constexpr float kSpread = 1.5f;
/// Lumels to either side of two that are compared with each other.
constexpr int kPatch = 1;
/// Normals of lumels that mix differ by less than 25 degrees.
const float kCosAlike = std::cos(glm::radians(25.0f));
/// One may lie this far out of the plane of the other, and be so many times as large.
constexpr float kOutOfPlane = 0.5f, kSizes = 2.0f;
/// Something nearer than this many times their distance may stand between two lumels; a ray between
/// them tells, this far above them in sides of a lumel.
constexpr float kMayStandBetween = 1.5f, kLift = 0.05f;
/// Lumels to either side over which the variance is averaged: so many that the weights hardly know
/// the lumel's own.
constexpr int kNoiseReach = 3;
constexpr std::size_t kGrain = 256;

}  // namespace

struct ChartFilter::Guide {
    const Estimates& light;
    std::vector<float> variance;  ///< [N] of one estimate, all channels together
};

ChartFilter::ChartFilter(const LinkScene& place, const WorldLumels& world, const LumelParts& parts,
                         const std::vector<float>& nearest)
    : place_(place),
      world_(world),
      parts_(parts),
      nearest_(nearest),
      by_side_(lumels_by_side(place.lumels))
{
}

/// On the same chart and side; kNoLumel where there is none.
std::uint32_t ChartFilter::neighbour(std::size_t i, int dx, int dy) const
{
    const Lumel& lumel = place_.lumels.lumels[i];
    const int width = place_.lumels.width;
    const int x = int(lumel.texel) % width + dx, y = int(lumel.texel) / width + dy;
    if (x < 0 || x >= width || y < 0 || y >= place_.lumels.height)
        return kNoLumel;
    const std::size_t texel = std::size_t(y) * std::size_t(width) + std::size_t(x);
    const std::uint32_t j = by_side_[2 * texel + (lumel.flags & kLumelBack ? 1 : 0)];
    if (j == kNoLumel || place_.lumels.lumels[j].chart != lumel.chart ||
        (place_.lumels.lumels[j].flags & kLumelBuried) != 0)
        return kNoLumel;
    return j;
}

bool ChartFilter::may_mix(std::size_t i, std::size_t j) const
{
    const WorldLumel &a = world_[i], &b = world_[j];
    const glm::vec3 apart = b.centre - a.centre;
    if (parts_.is_cut(j) || glm::dot(a.normal, b.normal) < kCosAlike ||
        std::abs(glm::dot(a.normal, apart)) > kOutOfPlane * a.size || a.size > kSizes * b.size ||
        b.size > kSizes * a.size)
        return false;
    const float distance = glm::length(apart);
    if (std::min(nearest_[i], nearest_[j]) > kMayStandBetween * distance)
        return true;
    const float lift = std::max(kLift * std::max(a.size, b.size), place_.rays.lift());
    return place_.rays.sees(a.centre + lift * a.normal, b.centre + lift * b.normal, 0.0f,
                            std::uint32_t(i));
}

/// By how far the guide differs around the two, beyond its noise.
float ChartFilter::weight(const Guide& guide, std::size_t i, std::size_t j, int dx, int dy) const
{
    float squares = 0.0f, noise = 0.0f;
    for (int y = -kPatch; y <= kPatch; ++y)
        for (int x = -kPatch; x <= kPatch; ++x) {
            const std::uint32_t a = neighbour(i, x, y), b = neighbour(i, dx + x, dy + y);
            if (a == kNoLumel || b == kNoLumel)
                continue;
            const glm::vec3 d = guide.light[a] - guide.light[b];
            squares += glm::dot(d, d);
            noise += guide.variance[a] + guide.variance[b];
        }
    const float own = guide.variance[i], theirs = guide.variance[j];
    const float expected =
        noise > 0.0f ? noise * (own + std::min(own, theirs)) / (own + theirs + 1e-30f) : 0.0f;
    return noise > 0.0f ? std::exp(-std::max(0.0f, squares - expected) / noise)
                        : (squares > 0.0f ? 0.0f : 1.0f);
}

void ChartFilter::filter(const Estimates& light, const Estimates& one, const Estimates& other,
                         Estimates& filtered_one, Estimates& filtered_other) const
{
    const std::size_t count = light.size();
    Guide guide{light, std::vector<float>(count)};
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            float sum = 0.0f, n = 0.0f;
            for (int y = -kNoiseReach; y <= kNoiseReach; ++y)
                for (int x = -kNoiseReach; x <= kNoiseReach; ++x)
                    if (const std::uint32_t j = neighbour(i, x, y); j != kNoLumel) {
                        const glm::vec3 d = one[j] - other[j];
                        sum += 0.5f * glm::dot(d, d);
                        n += 1.0f;
                    }
            guide.variance[i] = n > 0.0f ? sum / n : 0.0f;
        }
    });
    filtered_one = one;
    filtered_other = other;
    parallel_for(count, kGrain, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            if ((place_.lumels.lumels[i].flags & kLumelBuried) || parts_.is_cut(i))
                continue;
            float weights = 1.0f;
            for (int dy = -kReach; dy <= kReach; ++dy)
                for (int dx = -kReach; dx <= kReach; ++dx) {
                    const std::uint32_t j = dx || dy ? neighbour(i, dx, dy) : kNoLumel;
                    if (j == kNoLumel)
                        continue;
                    const float near =
                        std::exp(-0.5f * float(dx * dx + dy * dy) / (kSpread * kSpread));
                    const float w = near * weight(guide, i, j, dx, dy);
                    if (w < 0.01f || !may_mix(i, j))
                        continue;
                    weights += w;
                    filtered_one[i] += w * one[j];
                    filtered_other[i] += w * other[j];
                }
            filtered_one[i] /= weights;
            filtered_other[i] /= weights;
        }
    });
}

}  // namespace lumel
