// H = ∫ L cosθ dω of a point x by R rays of density cosθ / π, and shadow rays to sources:
//
//     H ≈ 1/R Σ π L + Σ_s D_s,
//
// where π L is ρH of the lumel that a ray hits, or π L of the sky, and D_s the direct light of an
// emissive surface, a lamp, a sun or the bright part of a sky, sampled and estimated as in bakes
// (lights/sources.h, lights/source_estimate.h). Emission of surfaces is in D_s only.
//
// The spread of the means of sets of rays gives the noise (results/measure/ray_sets.h).

#include "results/measure/light_meter.h"

#include <array>
#include <cmath>

#include "base/core/luminance.h"
#include "lights/source_estimate.h"
#include "rays/paths/directions.h"
#include "results/measure/ray_sets.h"

namespace lumel {

LightMeter::LightMeter(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                       const Lumels& lumels, std::span<const glm::vec3> irradiance,
                       const LightMeterOptions& options)
    : light_(scene, rays, atlas, lumels, irradiance),
      rays_of_set_(rays_of_set(options.samples)),
      seed_(options.seed)
{
}

Reading LightMeter::read(const MeterPoint& point, std::uint32_t number) const
{
    const float ray_offset = light_.ray_offset(point.position, point.normal);
    const RayOrigin start = origin_at(point.position + ray_offset * point.normal, point.normal);
    const RayAllocation shares = light_.allocate_rays(start.position, rays_of_set_);
    std::array<double, kRaySets> lux;
    Reading reading;
    std::uint32_t backs = 0;
    for (std::uint32_t set = 0; set < kRaySets; ++set) {
        const std::uint32_t stream = stream_of_set(seed_, number, set);
        const glm::vec3 light =
            along_rays(start, stream, backs) + from_sources(start, shares, stream);
        reading.light += light / float(kRaySets);
        lux[set] = luminance(light);
        reading.lux += lux[set] / kRaySets;
    }
    double squares = 0.0;
    for (const double of_set : lux)
        squares += (of_set - reading.lux) * (of_set - reading.lux);
    reading.noise = standard_error(squares);
    reading.inside = tell_of_inside(backs, double(kRaySets) * double(rays_of_set_));
    return reading;
}

glm::vec3 LightMeter::along_rays(const RayOrigin& start, std::uint32_t stream,
                                 std::uint32_t& backs) const
{
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < rays_of_set_; ++k) {
        const PathSamples samples(stream, k);
        const glm::vec2 disc = square_to_disc(samples.stratified(kDirectionPair));
        const float up = std::sqrt(std::max(1.0f - glm::dot(disc, disc), 0.0f));
        sum += light_.met_along(start.position, turn_to(start.normal, disc.x, disc.y, up),
                                samples.bits(kSeedPair), backs);
    }
    return sum / float(rays_of_set_);
}

glm::vec3 LightMeter::from_sources(const RayOrigin& start, const RayAllocation& shares,
                                   std::uint32_t stream) const
{
    glm::vec3 sum(0.0f);
    for (const RayAllocation::Own& own : shares.own)
        sum += from_source(start, own, stream);
    for_shared_rays(shares, stream, 0, shares.rest_rays,
                    [&](std::size_t source, float chance, const glm::vec2& at, std::uint32_t seed) {
                        const SourceSample sample = light_.sources().sample(source, start, at);
                        sum += light_.transmittance(start, sample, seed) * sample.irradiance /
                               (chance * float(shares.rest_rays));
                    });
    return sum;
}

glm::vec3 LightMeter::from_source(const RayOrigin& start, const RayAllocation::Own& own,
                                  std::uint32_t stream) const
{
    SourceEstimate found;
    for_rays_towards(own.source, stream, 0, own.rays, [&](const glm::vec2& at, std::uint32_t seed) {
        const SourceSample sample = light_.sources().sample(own.source, start, at);
        found.add(sample, light_.transmittance(start, sample, seed));
    });
    return found.light();
}

}  // namespace lumel
