// A point x reflects to the eye  ∫ L(y → x) ρ_s f_r cosθ dω.  With ω drawn from the lobe itself, of
// density q_B = f_r max(cosθ, cosθ_eye), one ray estimates it as
//
//     w ρ_s L(y → x) cosθ / max(cosθ, cosθ_eye),        w = n_B q_B / (n_A q_A + n_B q_B).
//
// The emission and diffuse reflection of y come from the lightmap. The light of its lobe is
// estimated recursively along that lobe: shooters leave it out (eye_image.receive.comp). There, and
// at x without shooters, a second ray to a point drawn by power replaces the shooters in the
// weights: Russian roulette gives the few surviving rays large weights, and few of those would hit
// small lamps. Lamps, which no ray hits, get a shadow ray at each of these points; the sky is found
// by rays along the lobe only.

#include "results/picture/lobe_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/parallel.h"
#include "lights/source_choice.h"
#include "methods/glossy/phong.h"
#include "rays/paths/samples.h"

namespace lumel {
namespace {

/// Maximum lobes per ray: facing mirrors would reflect it forever.
constexpr std::uint32_t kMaxLobes = 16;
/// Throughput below which a ray takes part in Russian roulette: reflectance of glazed surfaces. A
/// larger value makes the few narrow second lobes that lead to a lamp visible as noise.
constexpr float kRouletteBelow = 0.04f;
/// Dimension pairs of a ray's random numbers: direction, roulette, target point, lamp, and point on
/// the lamp.
constexpr std::uint32_t kPairsPerLobe = 6;
constexpr std::size_t kLobePointsPerTask = 64;
/// Points between progress reports.
constexpr std::size_t kPointsPerStep = 65536;

class LobeRays {
public:
    LobeRays(const LitScene& lit, const PowerDraw& senders, const LobeRayOptions& options)
        : rays_(lit.rays()),
          surfaces_(lit.surfaces()),
          lit_(lit),
          senders_(senders),
          options_(options),
          ray_offset_(rays_.ray_offset())
    {
    }

    /// Adds one estimate of the light that a point reflects to the eye, of each layer: all layers
    /// follow the same rays, so they add up to the light of all lamps.
    void estimate(EyePoint x, const PathSamples& samples, std::span<glm::vec3> sum) const
    {
        glm::vec3 throughput(1.0f);
        for (std::uint32_t lobe = 0; lobe < kMaxLobes; ++lobe) {
            const std::uint32_t pair = kPairsPerLobe * lobe;
            const Techniques techniques = techniques_at(lobe);
            const float cos_eye = glm::dot(x.normal, x.toward_eye);
            if (cos_eye <= 0.0f)
                break;
            const glm::vec3 mirror = 2.0f * cos_eye * x.normal - x.toward_eye;
            if (techniques.seeks)
                add_sought(x, mirror, samples, pair, throughput, sum);
            if (lit_.lamps().count() > 0)
                add_lamplight(x, mirror, samples, pair, throughput, sum);

            const glm::vec3 direction = phong_direction(
                mirror, x.shininess, lobe == 0 ? samples.stratified(pair) : samples.random(pair));
            const float cos_in = glm::dot(x.normal, direction);
            RayHit hit;
            const glm::vec3 origin = x.position + ray_offset_ * x.facing;
            if (cos_in <= 0.0f || glm::dot(x.facing, direction) <= 0.0f)
                break;
            throughput *= x.specular * (cos_in / std::max(cos_in, cos_eye));
            const bool met =
                rays_.closest(origin, direction, 0.0f, std::numeric_limits<float>::max(),
                              samples.bits(pair), hit);
            throughput *= hit.tint;
            if (!met) {
                lit_.add_sky(direction, throughput, sum);  // found by no other technique
                break;
            }
            const Shading there = surfaces_.shade(hit);
            const float rays =
                techniques.rays * phong_density(glm::dot(mirror, direction), x.shininess);
            const float others = techniques.others * density(hit, direction);
            add_sent(there, hit, throughput * (rays > 0.0f ? rays / (rays + others) : 0.0f), sum);

            if (there.reflectance.specular == glm::vec3(0.0f))
                break;
            throughput *=
                survival(throughput, there.reflectance.specular, samples.random(pair + 1));
            if (throughput == glm::vec3(0.0f))
                break;
            x = {origin + direction * hit.distance,
                 there.normal,
                 there.geometric,
                 -direction,
                 there.reflectance.specular,
                 there.reflectance.shininess};
        }
    }

private:
    /// Techniques that select y from a point.
    struct Techniques {
        float rays;    ///< number along its lobe
        float others;  ///< number drawn by power
        bool seeks;    ///< the latter by one ray each; false: by the shooters
    };

    Techniques techniques_at(std::uint32_t lobe) const
    {
        if (lobe == 0 && options_.shooters > 0.0f)
            return {float(options_.rays), options_.shooters, false};
        const bool seeks = senders_.power() > 0.0;
        return {1.0f, seeks ? 1.0f : 0.0f, seeks};
    }

    /// Adds the diffuse radiance of y × weight [cd/m²].
    void add_sent(const Shading& there, const RayHit& hit, const glm::vec3& weight,
                  std::span<glm::vec3> sum) const
    {
        lit_.add_light(hit, there.luminance, there.reflectance.diffuse, weight, sum);
    }

    /// q_A of a hit: density of drawing y by power [1/sr].
    float density(const RayHit& hit, const glm::vec3& direction) const
    {
        const std::uint32_t j = lit_.lumel(hit);
        const float cos_there = std::abs(glm::dot(hit.normal, direction));
        if (!(senders_.power() > 0.0) || j == HitLumels::kNone || cos_there <= 0.0f)
            return 0.0f;
        return senders_.density(j) * hit.distance * hit.distance / cos_there;
    }

    /// Adds the light that x reflects to the eye from a y drawn by power, weighted against rays
    /// along the lobe, × throughput.
    void add_sought(const EyePoint& x, const glm::vec3& mirror, const PathSamples& samples,
                    std::uint32_t pair, const glm::vec3& throughput, std::span<glm::vec3> sum) const
    {
        const double place = double(samples.random(pair + 2).x) * senders_.power();
        const std::uint32_t j = senders_.lumel(place);
        const glm::vec3 origin = x.position + ray_offset_ * x.facing;
        const glm::vec3 direction =
            glm::normalize(senders_.point(j, samples.random(pair + 3)).position - origin);
        const float cos_in = glm::dot(x.normal, direction),
                    cos_eye = glm::dot(x.normal, x.toward_eye);
        const float along = phong_density(glm::dot(mirror, direction), x.shininess);
        if (!(along > 0.0f) || cos_in <= 0.0f || !(glm::dot(x.facing, direction) > 0.0f))
            return;
        RayHit hit;
        if (!rays_.closest(origin, direction, 0.0f, std::numeric_limits<float>::max(),
                           samples.bits(pair + 2), hit) ||
            lit_.lumel(hit) != j)
            return;
        const float drawn = density(hit, direction);
        if (!(drawn > 0.0f))
            return;
        const float reflects = along * cos_in / std::max(cos_in, cos_eye);
        add_sent(surfaces_.shade(hit), hit,
                 throughput * hit.tint * x.specular * (reflects / (drawn + along)), sum);
    }

    /// Adds the light that x reflects to the eye from the lamps × throughput: of each layer one
    /// lamp, selected by it.
    void add_lamplight(const EyePoint& x, const glm::vec3& mirror, const PathSamples& samples,
                       std::uint32_t pair, const glm::vec3& throughput,
                       std::span<glm::vec3> sum) const
    {
        const LightSources& lamps = lit_.lamps();
        const RayOrigin start{.position = x.position + ray_offset_ * x.facing,
                              .normal = x.normal,
                              .geometric = x.facing,
                              .cell = 0};
        const float cos_eye = glm::dot(x.normal, x.toward_eye);
        for (std::size_t layer = 0; layer < lit_.layers(); ++layer) {
            SourceChoice choice(double(samples.random(pair + 5).x));
            for (std::size_t i = 0; i < lamps.count(); ++i) {
                if (lit_.layer_of_lamp(i) != layer)
                    continue;
                const SourceSample lamp = lamps.sample(i, start, samples.random(pair + 4));
                const float lobe = phong_lobe(start.cosine(lamp.direction), cos_eye,
                                              glm::dot(mirror, lamp.direction), x.shininess);
                choice.offer(lamp, x.specular * lamp.irradiance * lobe);
            }
            if (!choice.empty())
                sum[layer] +=
                    throughput * choice.light() *
                    transmittance_to(rays_, choice.sample(), start, samples.bits(pair + 4));
        }
    }

    /// Weight by Russian roulette before another lobe: 0 for rays that end.
    static float survival(const glm::vec3& throughput, const glm::vec3& specular,
                          const glm::vec2& random)
    {
        const glm::vec3 next = throughput * specular;
        const float chance = std::min(std::max({next.x, next.y, next.z}) / kRouletteBelow, 1.0f);
        return random.x < chance ? 1.0f / chance : 0.0f;
    }

    const RayScene& rays_;
    const Surfaces& surfaces_;
    const LitScene& lit_;
    const PowerDraw& senders_;
    LobeRayOptions options_;
    float ray_offset_;  ///< [m]
};

}  // namespace

std::vector<glm::vec3> gather_along_lobes(std::span<const EyePoint> points, const LitScene& lit,
                                          const PowerDraw& senders, const LobeRayOptions& options,
                                          const std::function<bool(double)>& progress)
{
    const LobeRays lobes(lit, senders, options);
    const std::size_t layers = lit.layers();
    std::vector<glm::vec3> radiance(points.size() * layers, glm::vec3(0.0f));
    // One ray of every point at a time: with the weights of the requested number, fewer are correct
    // too.
    std::uint32_t taken = 0;
    for (bool stopped = false; taken < options.rays && !stopped; ++taken) {
        const auto follow = [&](std::size_t first, std::size_t last) {
            for (std::size_t e = first; e < last; ++e) {
                const std::uint32_t stream =
                    PathSamples::hash(options.seed, options.first + std::uint32_t(e));
                lobes.estimate(points[e], PathSamples(stream, taken),
                               std::span(radiance).subspan(e * layers, layers));
            }
        };
        const auto report = [&](std::size_t done) {
            const double share = double(done) / double(points.size());
            stopped |= progress && !progress((taken + share) / options.rays);
            return true;
        };
        parallel_steps(points.size(), kPointsPerStep, kLobePointsPerTask, follow, report);
    }
    for (glm::vec3& sum : radiance)
        sum /= float(std::max(taken, 1u));
    return radiance;
}

}  // namespace lumel
