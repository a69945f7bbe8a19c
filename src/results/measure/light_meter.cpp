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
#include <limits>

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

RayOrigin LightMeter::start_at(const MeterPoint& point) const
{
    const float ray_offset = light_.ray_offset(point.position, point.normal);
    return origin_at(point.position + ray_offset * point.normal, point.normal);
}

Reading LightMeter::read(const MeterPoint& point, std::uint32_t number) const
{
    const RayOrigin start = start_at(point);
    const RayAllocation shares =
        light_.allocate_rays(receiver_at(start.position, start.normal), rays_of_set_);
    std::array<double, kRaySets> lux;
    Reading reading;
    std::uint32_t backs = 0;
    for (std::uint32_t set = 0; set < kRaySets; ++set) {
        const std::uint32_t stream = stream_of_set(seed_, number, set);
        glm::vec3 along(0.0f), sources(0.0f);
        along_rays(start, stream, backs,
                   [&](const glm::vec3&, const MetLight& met) { along += met.light; });
        from_sources(start, shares, stream,
                     [&](std::size_t, const glm::vec3& light) { sources += light; });
        const glm::vec3 light = along / float(rays_of_set_) + sources;
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

LampReadings LightMeter::read_lamps(const MeterPoint& point, std::uint32_t number,
                                    const LampShares& shares) const
{
    const RayOrigin start = start_at(point);
    const RayAllocation allocation =
        light_.allocate_rays(receiver_at(start.position, start.normal), rays_of_set_);
    LampReadings readings{.lux = std::vector<double>(shares.lamps.all.size(), 0.0)};
    std::vector<double>& lux = readings.lux;
    std::uint32_t backs = 0;
    const double rays = double(kRaySets) * double(rays_of_set_);
    const auto add_met = [&](const glm::vec3&, const MetLight& met) {
        if (met.is_sky)
            lux[shares.lamps.of_dim_sky] += luminance(met.light) / rays;
        else if (met.lumel != HitLumels::kNone)
            for (std::size_t k = 0; k < lux.size(); ++k)
                lux[k] += luminance(met.light * shares.of_lumels[k][met.lumel]) / rays;
    };
    for (std::uint32_t set = 0; set < kRaySets; ++set) {
        const std::uint32_t stream = stream_of_set(seed_, number, set);
        along_rays(start, stream, backs, add_met);
        from_sources(start, allocation, stream, [&](std::size_t source, const glm::vec3& light) {
            lux[shares.lamps.of_source[source]] += luminance(light) / double(kRaySets);
        });
    }
    readings.inside = tell_of_inside(backs, rays);
    return readings;
}

bool LightMeter::visit_rays(const MeterPoint& point, std::uint32_t number,
                            const RayVisitor& visit) const
{
    const RayOrigin start = start_at(point);
    std::uint32_t backs = 0;
    for (std::uint32_t set = 0; set < kRaySets; ++set)
        along_rays(
            start, stream_of_set(seed_, number, set), backs,
            [&](const glm::vec3& direction, const MetLight& met) { visit(set, direction, met); });
    return tell_of_inside(backs, double(kRaySets) * double(rays_of_set_));
}

glm::vec3 LightMeter::light_from(const MeterPoint& point, const glm::vec3& direction,
                                 std::uint32_t seed) const
{
    const RayOrigin start = start_at(point);
    const SourceSample sample{.direction = direction,
                              .distance = std::numeric_limits<float>::infinity(),
                              .irradiance = glm::vec3(start.cosine(direction))};
    return light_.transmittance(start, sample, seed) * sample.irradiance;
}

/// Calls add(direction, met) for each ray of a set.
template <class Add>
void LightMeter::along_rays(const RayOrigin& start, std::uint32_t stream, std::uint32_t& backs,
                            const Add& add) const
{
    for (std::uint32_t k = 0; k < rays_of_set_; ++k) {
        const PathSamples samples(stream, k);
        const glm::vec2 disc = square_to_disc(samples.stratified(kDirectionPair));
        const float up = std::sqrt(std::max(1.0f - glm::dot(disc, disc), 0.0f));
        const glm::vec3 direction = turn_to(start.normal, disc.x, disc.y, up);
        add(direction, light_.met_along(start.position, direction, samples.bits(kSeedPair), backs));
    }
}

/// Calls add(source, light) for parts of the light of a set.
template <class Add>
void LightMeter::from_sources(const RayOrigin& start, const RayAllocation& shares,
                              std::uint32_t stream, const Add& add) const
{
    for (const RayAllocation::Own& own : shares.own)
        add(own.source, from_source(start, own, stream));
    for_shared_rays(shares, stream, 0, shares.rest_rays,
                    [&](std::size_t source, float chance, const glm::vec2& at, std::uint32_t seed) {
                        const SourceSample sample = light_.sources().sample(source, start, at);
                        add(source, light_.transmittance(start, sample, seed) * sample.irradiance /
                                        (chance * float(shares.rest_rays)));
                    });
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
