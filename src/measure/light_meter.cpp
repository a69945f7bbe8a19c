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
#include <limits>
#include <numbers>

#include "core/luminance.h"
#include "links/found_light.h"
#include "links/looks.h"
#include "paths/directions.h"
#include "paths/samples.h"

namespace lumel {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Independent sets of rays. Of 16 values the spread is known to a fifth.
constexpr std::uint32_t kSets = 16;
/// Rays of a set to a source that has rays of its own, at least.
constexpr std::uint32_t kFewRays = 4;
/// A point is inside of something if more than this share of its rays meet backs.
constexpr double kMostBacks = 0.5;
/// Dimension pairs of a ray's random numbers, and the stream of sources that share rays.
constexpr std::uint32_t kDirectionPair = 0, kSeedPair = 1, kSourcePair = 0, kChoicePair = 2;
constexpr std::uint32_t kRestStream = 1, kFirstSourceStream = 2;

std::vector<glm::vec3> reflected_by(const Lumels& lumels, std::span<const glm::vec3> irradiance)
{
    std::vector<glm::vec3> reflected;
    reflected.reserve(irradiance.size());
    for (std::size_t i = 0; i < irradiance.size(); ++i) {
        const Lumel& lumel = lumels.lumels[i];
        reflected.push_back(lumel.flags & kLumelBuried ? glm::vec3(0.0f)
                                                       : lumel.albedo * irradiance[i]);
    }
    return reflected;
}

}  // namespace

LightMeter::LightMeter(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                       const Lumels& lumels, std::span<const glm::vec3> irradiance,
                       const LightMeterOptions& options)
    : rays_(rays),
      surfaces_(scene),
      sources_(scene, surfaces_, glm::distance(rays.low(), rays.high())),
      hits_(scene, atlas, lumels),
      reflected_(reflected_by(lumels, irradiance)),
      rays_of_set_(std::max((options.samples + kSets - 1) / kSets, kFewRays)),
      seed_(options.seed)
{
}

Reading LightMeter::read(const MeterPoint& point, std::uint32_t number) const
{
    const RayStart start{.position = point.position + rays_.lift() * point.normal,
                         .normal = point.normal,
                         .geometric = point.normal,
                         .cell = 0};
    const Shares shares = share_out(start);
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

/// Sources have rays in proportion to what they may send; those that would have very few share
/// theirs, unless there are rays for all.
LightMeter::Shares LightMeter::share_out(const RayStart& start) const
{
    Shares shares;
    const std::size_t count = sources_.count();
    std::vector<float> guesses;
    double total = 0.0;
    for (std::size_t s = 0; s < count; ++s)
        total += double(guesses.emplace_back(sources_.guess(s, start.position, 0.0f)));
    const bool for_all = count * kFewRays <= rays_of_set_;
    double rest = 0.0;
    shares.rest.reserve(count);
    for (std::size_t s = 0; s < count; ++s) {
        const double rays = total > 0.0 ? double(rays_of_set_) * double(guesses[s]) / total : 0.0;
        if (for_all || rays >= kFewRays)
            shares.own.push_back({s, std::max(std::uint32_t(std::ceil(rays)), kFewRays)});
        else
            rest += double(guesses[s]);
        shares.rest.push_back(float(rest));
    }
    if (rest > 0.0)
        shares.rest_rays =
            std::max(std::uint32_t(std::ceil(double(rays_of_set_) * rest / total)), kFewRays);
    return shares;
}

/// π L along a ray, but for what surfaces emit [lx].
glm::vec3 LightMeter::met_along(const RayStart& start, const glm::vec3& direction,
                                std::uint32_t seed, std::uint32_t& backs) const
{
    RayHit hit;
    if (!rays_.closest(ray_out(start.position, direction, seed), hit))
        return kPi * hit.tint * sources_.rest_of_sky(direction);
    if (!hit.front && !surfaces_.all()[surfaces_.index(hit.instance, hit.primitive)].double_sided) {
        ++backs;
        return glm::vec3(0.0f);
    }
    const std::uint32_t lumel = hits_.lumel(hit);
    return lumel == HitLumels::kNone ? glm::vec3(0.0f) : hit.tint * reflected_[lumel];
}

glm::vec3 LightMeter::along_rays(const RayStart& start, std::uint32_t stream,
                                 std::uint32_t& backs) const
{
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < rays_of_set_; ++k) {
        const PathSamples samples(stream, k);
        const glm::vec2 disc = square_to_disc(samples.stratified(kDirectionPair));
        const float up = std::sqrt(std::max(1.0f - glm::dot(disc, disc), 0.0f));
        sum += met_along(start, turn_to(start.normal, disc.x, disc.y, up), samples.bits(kSeedPair),
                         backs);
    }
    return sum / float(rays_of_set_);
}

glm::vec3 LightMeter::from_sources(const RayStart& start, const Shares& shares,
                                   std::uint32_t stream) const
{
    glm::vec3 sum(0.0f);
    for (const Shares::Own& own : shares.own)
        sum += from_source(
            start, own, PathSamples::hash(stream, kFirstSourceStream + std::uint32_t(own.source)));
    if (shares.rest_rays > 0)
        sum += from_rest(start, shares, PathSamples::hash(stream, kRestStream));
    return sum;
}

glm::vec3 LightMeter::from_source(const RayStart& start, const Shares::Own& own,
                                  std::uint32_t stream) const
{
    FoundLight found;
    for (std::uint32_t k = 0; k < own.rays; ++k) {
        const PathSamples samples(stream, k);
        const SourceSample sample =
            sources_.sample(own.source, start, samples.stratified(kSourcePair));
        found.add(sample, passing(start, sample, samples.bits(kSeedPair)));
    }
    return found.light();
}

/// Each ray chooses one of the sources by what it may send, and stands for all.
glm::vec3 LightMeter::from_rest(const RayStart& start, const Shares& shares,
                                std::uint32_t stream) const
{
    const std::vector<float>& running = shares.rest;
    glm::vec3 sum(0.0f);
    for (std::uint32_t k = 0; k < shares.rest_rays; ++k) {
        const PathSamples samples(stream, k);
        const float mark = samples.stratified(kChoicePair).x * running.back();
        const auto chosen = std::upper_bound(running.begin(), running.end() - 1, mark);
        const float guess = *chosen - (chosen == running.begin() ? 0.0f : *(chosen - 1));
        if (!(guess > 0.0f))
            continue;
        const SourceSample sample = sources_.sample(std::size_t(chosen - running.begin()), start,
                                                    samples.stratified(kSourcePair));
        sum += passing(start, sample, samples.bits(kSeedPair)) * sample.irradiance *
               (running.back() / guess);
    }
    return sum / float(shares.rest_rays);
}

/// The part of a sample's light that gets through; no ray is cast for none.
glm::vec3 LightMeter::passing(const RayStart& start, const SourceSample& sample,
                              std::uint32_t seed) const
{
    if (sample.irradiance == glm::vec3(0.0f))
        return glm::vec3(0.0f);
    return rays_.passing(ray_towards(sample, start, rays_.lift(), seed));
}

}  // namespace lumel
