#include "lights/ray_allocation.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

/// Minimum rays of a source with its own rays.
constexpr std::uint32_t kFewRays = 4;

}  // namespace

RayAllocation::Chosen RayAllocation::choose(float mark) const
{
    const auto chosen = std::upper_bound(rest.begin(), rest.end() - 1, mark * rest.back());
    const float guess = *chosen - (chosen == rest.begin() ? 0.0f : *(chosen - 1));
    return {std::size_t(chosen - rest.begin()), std::max(guess / rest.back(), 0.0f)};
}

RayAllocation allocate_rays(const LightSources& sources, const Receiver& receiver,
                            std::uint32_t rays)
{
    RayAllocation shares;
    const std::size_t count = sources.count();
    std::vector<float> guesses;
    double total = 0.0;
    for (std::size_t s = 0; s < count; ++s)
        total += double(guesses.emplace_back(sources.sampling_weight(s, receiver)));
    const bool for_all = count * kFewRays <= rays;
    double rest = 0.0;
    shares.rest.reserve(count);
    for (std::size_t s = 0; s < count; ++s) {
        const double part = total > 0.0 ? double(rays) * double(guesses[s]) / total : 0.0;
        if (guesses[s] > 0.0f && (for_all || part >= kFewRays))
            shares.own.push_back({s, std::max(std::uint32_t(std::ceil(part)), kFewRays)});
        else
            rest += double(guesses[s]);
        shares.rest.push_back(float(rest));
    }
    if (rest > 0.0)
        shares.rest_rays =
            std::max(std::uint32_t(std::ceil(double(rays) * rest / total)), kFewRays);
    return shares;
}

}  // namespace lumel
