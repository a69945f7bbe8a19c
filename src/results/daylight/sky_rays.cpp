// Direct light of patch k of the sky, by R rays of density cosθ / π, and of the sun at position s
// by shadow rays, with the transmittance τ of glass:
//
//     D_k = π/R Σ τ over the rays that leave through k,        D_s = τ cosθ_s

#include "results/daylight/sky_rays.h"

#include "base/core/frame.h"
#include "base/core/sphere.h"

namespace lumel {
namespace {

/// Dimension pairs of a ray's random numbers.
constexpr std::uint32_t kStartPair = 0, kWayPair = 1, kGlassPair = 2;

}  // namespace

SkyRays::SkyRays(const SolveScene& scene)
    : scene_(scene),
      world_(scene.scene, scene.rays, scene.lumels),
      starts_(world_, nullptr, false)
{
}

std::uint32_t SkyRays::stream_of(std::size_t lumel, std::uint32_t seed) const
{
    return PathSamples::hash(seed, lumel_key(scene_.lumels.lumels[lumel], scene_.lumels.width));
}

glm::vec3 SkyRays::send(std::size_t lumel, const PathSamples& samples, glm::vec3& direction) const
{
    const RayOrigin start = starts_.start(lumel, samples.stratified(kStartPair));
    direction = frame_about(start.normal) * by_cosine(samples.stratified(kWayPair));
    if (!(direction.y > 0.0f) || !(start.cosine(direction) > 0.0f))
        return glm::vec3(0.0f);
    return scene_.rays.transmittance_out(start.position, direction, samples.bits(kGlassPair));
}

glm::vec3 SkyRays::sun(std::size_t lumel, const glm::vec3& to_sun, std::uint32_t number,
                       std::uint32_t count, std::uint32_t seed) const
{
    const std::uint32_t stream = PathSamples::hash(stream_of(lumel, seed), number + 1);
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < count; ++k) {
        const PathSamples samples(stream, k);
        const RayOrigin start = starts_.start(lumel, samples.stratified(kStartPair));
        if (const float cosine = start.cosine(to_sun); cosine > 0.0f)
            sum += cosine *
                   scene_.rays.transmittance_out(start.position, to_sun, samples.bits(kGlassPair));
    }
    return sum / float(count);
}

}  // namespace lumel
