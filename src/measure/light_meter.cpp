// H = ∫ L cosθ dω of a point x by R rays of density cosθ / π, and rays towards sources:
//
//     H ≈ 1/R Σ π L + Σ_s D_s,
//
// where π L is ρH of the lumel that a ray meets, or π L of the sky where it meets nothing, and D_s
// the direct light of an emissive surface, a lamp, a sun or the bright part of a sky, sampled and
// estimated as bakes do it (links/sources.h, links/found_light.h). What surfaces emit counts in D_s
// alone.
//
// The rays are kSets sets of low-discrepancy points, each scrambled by itself, so that their means
// are independent: the spread of these means states the noise.

#include "measure/light_meter.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/luminance.h"
#include "links/found_light.h"
#include "paths/directions.h"
#include "paths/samples.h"

namespace lumel {
namespace {

/// Independent sets of rays. Of 16 values the spread is known to a fifth.
constexpr std::uint32_t kSets = 16;
/// Rays of a set, at least.
constexpr std::uint32_t kFewRays = 4;
/// A point is inside of something if more than this share of its rays tell so.
constexpr double kMostBacks = 0.5;
/// Dimension pairs of a ray's random numbers, and the stream of sources that share rays.
constexpr std::uint32_t kDirectionPair = 0, kSeedPair = 1, kSourcePair = 0, kChoicePair = 2;
constexpr std::uint32_t kRestStream = 1, kFirstSourceStream = 2;

}  // namespace

LightMeter::LightMeter(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                       const Lumels& lumels, std::span<const glm::vec3> irradiance,
                       const LightMeterOptions& options)
    : light_(scene, rays, atlas, lumels, irradiance),
      rays_of_set_(std::max((options.samples + kSets - 1) / kSets, kFewRays)),
      seed_(options.seed)
{
}

Reading LightMeter::read(const MeterPoint& point, std::uint32_t number) const
{
    const RayStart start{.position = point.position + light_.lift() * point.normal,
                         .normal = point.normal,
                         .geometric = point.normal,
                         .cell = 0};
    const SourceShares shares = light_.share_out(start.position, rays_of_set_);
    std::array<double, kSets> lux;
    Reading reading;
    std::uint32_t backs = 0;
    for (std::uint32_t set = 0; set < kSets; ++set) {
        const std::uint32_t stream = PathSamples::hash(PathSamples::hash(seed_, number), set);
        const glm::vec3 light =
            along_rays(start, stream, backs) + from_sources(start, shares, stream);
        reading.light += light / float(kSets);
        lux[set] = luminance(light);
        reading.lux += lux[set] / kSets;
    }
    double squares = 0.0;
    for (const double of_set : lux)
        squares += (of_set - reading.lux) * (of_set - reading.lux);
    reading.noise = std::sqrt(squares / (kSets * (kSets - 1.0)));
    reading.inside = double(backs) > kMostBacks * double(kSets) * double(rays_of_set_);
    return reading;
}

glm::vec3 LightMeter::along_rays(const RayStart& start, std::uint32_t stream,
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

glm::vec3 LightMeter::from_sources(const RayStart& start, const SourceShares& shares,
                                   std::uint32_t stream) const
{
    glm::vec3 sum(0.0f);
    for (const SourceShares::Own& own : shares.own)
        sum += from_source(
            start, own, PathSamples::hash(stream, kFirstSourceStream + std::uint32_t(own.source)));
    if (shares.rest_rays > 0)
        sum += from_rest(start, shares, PathSamples::hash(stream, kRestStream));
    return sum;
}

glm::vec3 LightMeter::from_source(const RayStart& start, const SourceShares::Own& own,
                                  std::uint32_t stream) const
{
    FoundLight found;
    for (std::uint32_t k = 0; k < own.rays; ++k) {
        const PathSamples samples(stream, k);
        const SourceSample sample =
            light_.sources().sample(own.source, start, samples.stratified(kSourcePair));
        found.add(sample, light_.passing(start, sample, samples.bits(kSeedPair)));
    }
    return found.light();
}

/// Each ray chooses one of the sources by what it may send, and stands for all.
glm::vec3 LightMeter::from_rest(const RayStart& start, const SourceShares& shares,
                                std::uint32_t stream) const
{
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < shares.rest_rays; ++k) {
        const PathSamples samples(stream, k);
        const auto [source, chance] = shares.choose(samples.stratified(kChoicePair).x);
        if (!(chance > 0.0f))
            continue;
        const SourceSample sample =
            light_.sources().sample(source, start, samples.stratified(kSourcePair));
        sum += light_.passing(start, sample, samples.bits(kSeedPair)) * sample.irradiance / chance;
    }
    return sum / float(shares.rest_rays);
}

}  // namespace lumel
