// Light of sky, sun and lamps at every lumel, as coefficients of its directions.
//
// Rays start at points spread over the lumel. To lamps, suns and the bright parts of a sky they are
// sampled as in bakes (lights/sources.h): a sample of irradiance dH from ω is the radiance times
// the solid angle dH / cosθ. The rest of the sky is sampled uniformly over the hemisphere above the
// lumel; each ray represents a solid angle of 2π / R. Both are added to coefficients by the fit of
// directional_fit.cpp.

#include "results/directional/light_directions.h"

#include <cmath>

#include "base/core/parallel.h"
#include "base/core/pi.h"
#include "lights/ray_allocation.h"
#include "lights/shadow_rays.h"
#include "rays/paths/directions.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Approximate rays per lumel: to lamps, suns and bright parts of the sky together; to the rest of
/// the sky.
constexpr std::uint32_t kLampRays = 32, kSkyRays = 64;
/// Lumels per progress report, and minimum per task.
constexpr std::size_t kLumelsPerStep = 4096, kGrain = 16;
/// Dimension pairs of a ray's random numbers, and streams of sources.
constexpr std::uint32_t kReceiverPair = 0, kLampPair = 1, kRaySeedPair = 2, kLampChoicePair = 3;
constexpr std::uint32_t kSkyStream = 0, kRestStream = 1, kFirstSourceStream = 2;

using Coefficients = std::array<glm::vec3, kMaxCoefficients>;

class Finder {
public:
    Finder(const Scene& scene, const RayScene& rays, const Lumels& lumels,
           const std::vector<glm::vec3>& normals, const DirectionalFit& fit,
           const LightDirectionsOptions& options)
        : rays_(rays),
          surfaces_(scene),
          sources_(scene, surfaces_, glm::distance(rays.low(), rays.high()), {.surfaces = false}),
          places_(scene, rays, lumels),
          starts_(places_, nullptr, options.rule == SampleRule::centre),
          normals_(normals),
          fit_(fit),
          seed_(options.seed),
          has_sky_(!scene.sky.empty())
    {
    }

    Coefficients find(std::size_t i) const
    {
        Coefficients sums{};
        const std::uint32_t stream = PathSamples::hash(seed_, std::uint32_t(i));
        if (has_sky_)
            add_sky(i, PathSamples::hash(stream, kSkyStream), sums);
        add_lamps(i, stream, sums);
        return sums;
    }

private:
    /// light: radiance × solid angle.
    void add(std::size_t i, const glm::vec3& direction, const glm::vec3& light,
             Coefficients& sums) const
    {
        if (light == glm::vec3(0.0f))
            return;
        const auto c = fit_.coefficients_of(direction, normals_[i]);
        for (std::size_t k = 0; k < c.size(); ++k)
            sums[k] += c[k] * light;
    }

    void add_sky(std::size_t i, std::uint32_t stream, Coefficients& sums) const
    {
        for (std::uint32_t k = 0; k < kSkyRays; ++k) {
            const PathSamples samples(stream, k);
            const RayOrigin start = starts_.start(i, samples.stratified(kReceiverPair));
            const glm::vec2 at = samples.stratified(kLampPair);
            const float up = at.x, across = std::sqrt(1.0f - up * up), angle = 2.0f * kPi * at.y;
            const glm::vec3 direction =
                turn_to(normals_[i], across * std::cos(angle), across * std::sin(angle), up);
            const glm::vec3 sky = sources_.dim_sky(direction);
            if (sky == glm::vec3(0.0f) || !(glm::dot(start.geometric, direction) > 0.0f))
                continue;
            const glm::vec3 transmittance =
                rays_.transmittance_out(start.position, direction, samples.bits(kRaySeedPair));
            add(i, direction, transmittance * sky * (2.0f * kPi / float(kSkyRays)), sums);
        }
    }

    void add_lamps(std::size_t i, std::uint32_t stream, Coefficients& sums) const
    {
        const RayAllocation shares = allocate_rays(sources_, receiver_of(places_, i), kLampRays);
        for (const auto& [source, rays] : shares.own) {
            const std::uint32_t own =
                PathSamples::hash(stream, kFirstSourceStream + std::uint32_t(source));
            for (std::uint32_t k = 0; k < rays; ++k)
                add_sample(i, source, PathSamples(own, k), 1.0f / float(rays), sums);
        }
        const std::uint32_t rest = PathSamples::hash(stream, kRestStream);
        for (std::uint32_t k = 0; k < shares.rest_rays; ++k) {
            const PathSamples samples(rest, k);
            const auto [source, chance] = shares.choose(samples.stratified(kLampChoicePair).x);
            if (chance > 0.0f)
                add_sample(i, source, samples, 1.0f / (chance * float(shares.rest_rays)), sums);
        }
    }

    void add_sample(std::size_t i, std::size_t source, const PathSamples& samples, float weight,
                    Coefficients& sums) const
    {
        const RayOrigin start = starts_.start(i, samples.stratified(kReceiverPair));
        const SourceSample sample = sources_.sample(source, start, samples.stratified(kLampPair));
        const float cosine = start.cosine(sample.direction);
        if (cosine > 0.0f)
            add(i, sample.direction,
                transmittance_to(rays_, sample, start, samples.bits(kRaySeedPair)) *
                    sample.irradiance * (weight / cosine),
                sums);
    }

    const RayScene& rays_;
    Surfaces surfaces_;
    LightSources sources_;
    WorldLumels places_;
    RayOrigins starts_;
    const std::vector<glm::vec3>& normals_;
    const DirectionalFit& fit_;
    std::uint32_t seed_;
    bool has_sky_;
};

}  // namespace

bool has_far_lights(const Scene& scene)
{
    return !scene.sky.empty() || !scene.lights.empty();
}

bool add_light_directions(const Scene& scene, const RayScene& rays, const Lumels& lumels,
                          const std::vector<glm::vec3>& normals, const DirectionalFit& fit,
                          const LightDirectionsOptions& options,
                          std::vector<std::vector<glm::vec3>>& coefficients,
                          const std::function<bool(double)>& go_on)
{
    const Finder finder(scene, rays, lumels, normals, fit, options);
    const std::size_t count = lumels.lumels.size();
    return parallel_steps(
        count, kLumelsPerStep, kGrain,
        [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) {
                if (lumels.lumels[i].flags & kLumelBuried)
                    continue;
                const Coefficients own = finder.find(i);
                for (std::size_t c = 0; c < coefficients.size(); ++c)
                    coefficients[c][i] += own[c];
            }
        },
        [&](std::size_t done) { return !go_on || go_on(double(done) / double(count)); });
}

}  // namespace lumel
