#pragma once
// Rays to one point: kRaySets sets of low-discrepancy points with separate scrambling, so that the
// sets' means are independent and their spread gives the noise.

#include <algorithm>
#include <cmath>

#include "lights/ray_allocation.h"
#include "rays/paths/samples.h"

namespace lumel {

/// Number of sets; the spread of 16 values is known to a fifth.
inline constexpr std::uint32_t kRaySets = 16;
/// Dimension pairs of a ray's random numbers.
inline constexpr std::uint32_t kDirectionPair = 0, kSourcePair = 0, kSeedPair = 1, kChoicePair = 2;

inline std::uint32_t rays_of_set(std::uint32_t samples)
{
    constexpr std::uint32_t kMin = 4;
    return std::max((samples + kRaySets - 1) / kRaySets, kMin);
}

/// Random stream of a set at a point of this number.
inline std::uint32_t stream_of_set(std::uint32_t seed, std::uint32_t number, std::uint32_t set)
{
    return PathSamples::hash(PathSamples::hash(seed, number), set);
}

/// True if more than half of the rays hit unlit backs: the point is inside geometry.
inline bool tell_of_inside(std::uint32_t backs, double rays)
{
    constexpr double kMax = 0.5;
    return double(backs) > kMax * rays;
}

/// Standard error of a mean, from the sum of its sets' squared deviations.
inline double standard_error(double squares)
{
    return std::sqrt(squares / (kRaySets * (kRaySets - 1.0)));
}

/// Visits rays `from` to `to` to one source: visit(sample on it, seed)
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

/// Visits rays `from` to `to` to the sources that share rays: each selects one of them by sampling
/// weight, and represents all. visit(source, its probability, sample on it, seed)
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
