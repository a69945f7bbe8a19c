#include "links/direct/direct_rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "rays/paths/samples.h"
#include "solve/shooting/lumel_arrays.h"

namespace lumel {
namespace {

/// Minimum factor on the variance per pass, since its first estimate is rough.
constexpr double kMinPassShare = 1.0 / 16.0;
/// A pass adds at most this multiple of the rays so far.
constexpr std::uint64_t kMaxMore = 4;
/// Maximum rays per lumel, on average: light from a lamp in a lampshade or a niche can take rays
/// without end.
constexpr std::uint64_t kMaxDirectRays = 2048;
/// Random stream of these rays.
constexpr std::uint32_t kDirectRaysStream = 2;

std::vector<std::uint32_t> as_they_come(const WorldLumels& world)
{
    std::vector<std::uint32_t> order(world.size());
    std::iota(order.begin(), order.end(), 0u);
    return order;
}

}  // namespace

DirectRays::DirectRays(const SolveScene& scene, std::uint32_t seed, double target_error,
                       std::span<const glm::vec3> known,
                       const std::vector<std::uint32_t>& instances)
    : target_error_(target_error),
      known_(irradiance_sum(known)),
      work_(scene, {cast_on_host(scene.rays)}, SampleRule::area, as_they_come,
            {.lamps = false, .sky = false, .instances = instances}),
      finder_(work_, PathSamples::hash(seed, kDirectRaysStream))
{
}

void DirectRays::step()
{
    ++state_.iterations;
    if (finder_.step()) {
        state_.begun = finder_.fraction();
        return;
    }
    estimate();
    double share = kMinPassShare;
    if (target_error_ > 0.0 && state_.error > 0.0)
        share = std::clamp(std::pow(target_error_ / state_.error, 2.0), kMinPassShare, 1.0);
    const std::vector<double> even(work_.order.size(), 1.0);
    const std::uint64_t most = kMaxDirectRays * work_.order.size(), taken = finder_.rays();
    state_.full = taken >= most || !finder_.refine(share, std::min(kMaxMore * taken, most), even);
}

/// The difference of two independent halves has four times the variance of their mean.
void DirectRays::estimate()
{
    double squares = 0.0, light = known_, count = 0.0;
    for (std::size_t i = 0; i < work_.order.size(); ++i) {
        if (work_.is_buried(i))
            continue;
        const glm::vec3 apart = 0.5f * (finder_.half(0)[i] - finder_.half(1)[i]);
        const glm::vec3 mean = finder_.mean(i);
        squares += double(glm::dot(apart, apart));
        light += double(mean.r + mean.g + mean.b);
        count += 1.0;
    }
    // √(Σ d² / 3n) / (Σ H / 3n)
    state_.error = light > 0.0 ? std::sqrt(3.0 * count * squares) / light : 0.0;
    state_.shots = std::max<std::uint64_t>(1, finder_.rays() /
                                                  std::max<std::uint64_t>(1, std::uint64_t(count)));
    state_.begun = 1.0;
}

std::vector<glm::vec3> DirectRays::irradiance() const
{
    std::vector<glm::vec3> light(work_.order.size());
    for (std::size_t i = 0; i < light.size(); ++i)
        light[i] = finder_.mean(i);
    return light;
}

}  // namespace lumel
