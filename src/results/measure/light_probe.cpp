// c_lm = ∫ L Y_lm dω of a point x by R rays spread evenly over the sphere, and shadow rays to
// sources:
//
//     c_lm ≈ 4π/R Σ L(ω) Y_lm(ω) + Σ_s ∫ L_s Y_lm dω,
//
// where L is ρH/π of the lumel that a ray hits, or that of the sky. L_s is the light of an emissive
// surface, a lamp, a sun or the bright part of a sky, by shadow rays; emission of surfaces is in
// L_s only. A lamp or a sun without size is one direction, without noise.
//
// The spread of the means of sets of rays gives the noise (results/measure/ray_sets.h).

#include "results/measure/light_probe.h"

#include <algorithm>
#include <cmath>

#include "base/core/luminance.h"
#include "base/core/pi.h"
#include "results/measure/ray_sets.h"

namespace lumel {
namespace {

/// Rays are doubled until the noise is below this fraction of band 0, or up to kMaxTimes × as many.
constexpr double kEnough = 0.005;
constexpr std::uint32_t kMaxTimes = 64;

/// Maps the unit square uniformly to the sphere.
glm::vec3 on_sphere(const glm::vec2& at)
{
    const float y = 1.0f - 2.0f * at.x, angle = 2.0f * kPi * at.y;
    const float across = std::sqrt(std::max(1.0f - y * y, 0.0f));
    return {across * std::cos(angle), y, across * std::sin(angle)};
}

template <class Coefficients>
void add(Coefficients& sums, const glm::vec3& direction, const glm::vec3& light)
{
    if (light == glm::vec3(0.0f))
        return;
    const auto y = harmonics(direction);
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] += y[i] * light;
}

/// Half spaces that together contain a source: the axis, and whether the opposite one is included.
struct Halves {
    glm::vec3 axis;
    bool both;
};

Halves halves_of(const LightSources::SourceInfo& origin, const glm::vec3& position)
{
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    if (origin.part == LightSources::Part::sky)
        return {up, true};
    if (origin.sun)
        return {glm::normalize(glm::vec3(origin.sun->transform[2])), false};
    const glm::vec3 offset = origin.centre - position;
    const float distance = glm::length(offset);
    return distance > 0.0f ? Halves{offset / distance, !(distance > origin.radius)}
                           : Halves{up, true};
}

/// Mean of the sets' sums times a factor, and its noise by their spread.
template <class Sets>
ProbeLight mean_of(const Sets& sets, float factor)
{
    ProbeLight probe;
    for (std::size_t i = 0; i < probe.coefficients.size(); ++i) {
        for (const auto& sums : sets)
            probe.coefficients[i] += factor / float(kRaySets) * sums[i];
        const double mean = luminance(probe.coefficients[i]);
        double squares = 0.0;
        for (const auto& sums : sets) {
            const double off = luminance(factor * sums[i]) - mean;
            squares += off * off;
        }
        probe.noise = std::max(probe.noise, standard_error(squares));
    }
    return probe;
}

}  // namespace

LightProbe::LightProbe(const Scene& scene, const RayScene& rays, const Atlas& atlas,
                       const Lumels& lumels, std::span<const glm::vec3> irradiance,
                       const LightProbeOptions& options)
    : light_(scene, rays, atlas, lumels, irradiance),
      rays_of_set_(rays_of_set(options.samples)),
      seed_(options.seed)
{
}

ProbeLight LightProbe::read(const glm::vec3& position, std::uint32_t number) const
{
    const RayAllocation shares =
        light_.allocate_rays(receiver_at(position, glm::vec3(0.0f)), rays_of_set_);
    std::array<Coefficients, kRaySets> sums{};
    ProbeLight probe;
    std::uint32_t backs = 0;
    for (std::uint32_t from = 0, to = 1; from < kMaxTimes; from = to, to *= 2) {
        for (std::uint32_t set = 0; set < kRaySets; ++set) {
            const std::uint32_t stream = stream_of_set(seed_, number, set);
            add_rays(position, stream, from, to, backs, sums[set]);
            add_sources(position, shares, stream, from, to, sums[set]);
        }
        probe = mean_of(sums, 1.0f / float(to));
        probe.inside = tell_of_inside(backs, double(kRaySets) * double(rays_of_set_) * double(to));
        if (probe.inside || probe.noise <= kEnough * luminance(probe.coefficients[0]))
            break;
    }
    return probe;
}

void LightProbe::add_rays(const glm::vec3& position, std::uint32_t stream, std::uint32_t from,
                          std::uint32_t to, std::uint32_t& backs, Coefficients& sums) const
{
    // π L of a ray represents L over 4π / R of the sphere.
    const float share = 4.0f / float(rays_of_set_);
    for (std::uint32_t k = from * rays_of_set_; k < to * rays_of_set_; ++k) {
        const PathSamples samples(stream, k);
        const glm::vec3 direction = on_sphere(samples.stratified(kDirectionPair));
        add(sums, direction,
            share * light_.met_along(position, direction, samples.bits(kSeedPair), backs).light);
    }
}

void LightProbe::add_sources(const glm::vec3& position, const RayAllocation& shares,
                             std::uint32_t stream, std::uint32_t from, std::uint32_t to,
                             Coefficients& sums) const
{
    for (const RayAllocation::Own& own : shares.own)
        for_rays_towards(own.source, stream, from * own.rays, to * own.rays,
                         [&](const glm::vec2& at, std::uint32_t seed) {
                             add_sample(own.source, position, at, seed, 1.0f / float(own.rays),
                                        sums);
                         });
    for_shared_rays(shares, stream, from * shares.rest_rays, to * shares.rest_rays,
                    [&](std::size_t source, float chance, const glm::vec2& at, std::uint32_t seed) {
                        add_sample(source, position, at, seed,
                                   1.0f / (chance * float(shares.rest_rays)), sums);
                    });
}

/// Sources are sampled for surfaces; divides by the cosine of such a surface.
void LightProbe::add_sample(std::size_t source, const glm::vec3& position, const glm::vec2& at,
                            std::uint32_t seed, float weight, Coefficients& sums) const
{
    const Halves halves = halves_of(light_.sources().origin(source), position);
    for (const float side : {1.0f, -1.0f}) {
        if (side < 0.0f && !halves.both)
            break;
        const RayOrigin start = origin_at(position, side * halves.axis);
        const SourceSample sample = light_.sources().sample(source, start, at);
        const float cosine = start.cosine(sample.direction);
        if (cosine > 0.0f)
            add(sums, sample.direction,
                light_.transmittance(start, sample, seed) * sample.irradiance * (weight / cosine));
    }
}

}  // namespace lumel
