#pragma once
// The rays that bring light to one point: kSets sets of low-discrepancy points, each scrambled by
// itself, so that the sets' means are independent and their spread states the noise.

#include <algorithm>
#include <cmath>

#include "lights/ray_allocation.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Of 16 values the spread is known to a fifth.
inline constexpr std::uint32_t kRaySets = 16;
/// Dimension pairs of a ray's random numbers.
inline constexpr std::uint32_t kDirectionPair = 0, kSourcePair = 0, kSeedPair = 1, kChoicePair = 2;

inline std::uint32_t rays_of_set(std::uint32_t samples)
{
    constexpr std::uint32_t kMin = 4;
    return std::max((samples + kRaySets - 1) / kRaySets, kMin);
}

/// The random numbers of a set at a point of this number.
inline std::uint32_t stream_of_set(std::uint32_t seed, std::uint32_t number, std::uint32_t set)
{
    return PathSamples::hash(PathSamples::hash(seed, number), set);
}

/// Is a point inside of something, by its rays that tell so?
inline bool tell_of_inside(std::uint32_t backs, double rays)
{
    constexpr double kMax = 0.5;
    return double(backs) > kMax * rays;
}

/// Of a mean, by the sum of the squares of what its sets are off.
inline double standard_error(double squares)
{
    return std::sqrt(squares / (kRaySets * (kRaySets - 1.0)));
}

/// Visits rays `from` to `to` towards one source. visit(place on it, seed)
template <class Visit>
void for_rays_towards(std::size_t source, std::uint32_t stream, std::uint32_t from,
                      std::uint32_t to, const Visit& visit)
{
    constexpr std::uint32_t kFirstSource = 2;
    const std::uint32_t own = PathSamples::hash(stream, kFirstSource + std::uint32_t(source));
    for (std::uint32_t k = from; k < to; ++k) {
        const PathSamples samples(own, k);
        visit(samples.stratified(kSourcePair), samples.bits(kSeedPair));
    }
}

/// Visits rays `from` to `to` towards the sources that share rays: each chooses one of them by what
/// it may send, and stands for all. visit(source, its chance, place on it, seed)
template <class Visit>
void for_shared_rays(const RayAllocation& shares, std::uint32_t stream, std::uint32_t from,
                     std::uint32_t to, const Visit& visit)
{
    constexpr std::uint32_t kShared = 1;
    const std::uint32_t rest = PathSamples::hash(stream, kShared);
    for (std::uint32_t k = from; k < to; ++k) {
        const PathSamples samples(rest, k);
        const RayAllocation::Chosen chosen = shares.choose(samples.stratified(kChoicePair).x);
        if (chosen.chance > 0.0f)
            visit(chosen.source, chosen.chance, samples.stratified(kSourcePair),
                  samples.bits(kSeedPair));
    }
}

}  // namespace lumel
