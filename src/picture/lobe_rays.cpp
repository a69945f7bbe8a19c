// A point x reflects to the eye  ∫ L(y → x) ρ_s f_r cosθ dω.  With ω drawn from the lobe itself,
// whose density is q_B = f_r max(cosθ, cosθ_eye), one ray estimates it as
//
//     w ρ_s L(y → x) cosθ / max(cosθ, cosθ_eye),        w = n_B q_B / (n_A q_A + n_B q_B).
//
// What y sends is what it emits and reflects diffusely, from the lightmap. What its lobe sends the
// ray looks for in turn, along that: shooters leave it out (eye_image.receive.comp).

#include "picture/lobe_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.h"
#include "reference/samples.h"
#include "solve/phong.h"

namespace lumel {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Lobes that one ray follows at most: mirrors that face each other would hold it for ever.
constexpr int kMostLobes = 16;
/// Fewest points worth a task.
constexpr std::size_t kPointsPerTask = 64;
/// Points between two progress reports.
constexpr std::size_t kPointsPerStep = 65536;

class LobeRays {
public:
    LobeRays(const RayScene& rays, const Surfaces& surfaces, const LitScene& lit,
             std::span<const float> brightness, const LobeRayOptions& options)
        : rays_(rays),
          surfaces_(surfaces),
          lit_(lit),
          brightness_(brightness),
          options_(options),
          lift_(rays.lift())
    {
    }

    /// One estimate of what a point reflects to the eye.
    glm::vec3 estimate(EyePoint x, const PathSamples& samples) const
    {
        glm::vec3 sum(0.0f), throughput(1.0f);
        for (int lobe = 0; lobe < kMostLobes; ++lobe) {
            const auto pair = std::uint32_t(2 * lobe);
            const float cos_eye = glm::dot(x.normal, x.toward_eye);
            if (cos_eye <= 0.0f)
                break;
            const glm::vec3 mirror = 2.0f * cos_eye * x.normal - x.toward_eye;
            const glm::vec3 way = phong_direction(
                mirror, x.shininess, lobe == 0 ? samples.stratified(pair) : samples.random(pair));
            const float cos_in = glm::dot(x.normal, way);
            RayHit hit;
            const glm::vec3 origin = x.position + lift_ * x.facing;
            if (cos_in <= 0.0f || glm::dot(x.facing, way) <= 0.0f)
                break;
            throughput *= x.specular * (cos_in / std::max(cos_in, cos_eye));
            const bool met = rays_.closest(origin, way, 0.0f, std::numeric_limits<float>::max(),
                                           samples.bits(pair), hit);
            throughput *= hit.tint;
            if (!met) {
                sum += throughput * lit_.sky(way);  // shooters do not send it
                break;
            }
            const Shading there = surfaces_.shade(hit);
            const glm::vec3 sent =
                there.luminance + there.reflectance.diffuse * lit_.irradiance(hit) / kPi;
            const float density = phong_density(glm::dot(mirror, way), x.shininess);
            sum += throughput * sent * (lobe == 0 ? weight(hit, density, way) : 1.0f);

            if (there.reflectance.specular == glm::vec3(0.0f))
                break;
            throughput *=
                survival(throughput, there.reflectance.specular, samples.random(pair + 1));
            if (throughput == glm::vec3(0.0f))
                break;
            x = {origin + way * hit.distance,
                 there.normal,
                 there.geometric,
                 -way,
                 there.reflectance.specular,
                 there.reflectance.shininess};
        }
        return sum;
    }

private:
    /// The balance heuristic against shooters on the lumel that was hit.
    float weight(const RayHit& hit, float density, const glm::vec3& way) const
    {
        const std::uint32_t j = lit_.lumel(hit);
        const float cos_there = std::abs(glm::dot(hit.normal, way));
        if (options_.shooters == 0.0f || j == HitLumels::kNone || cos_there <= 0.0f)
            return 1.0f;
        const float shooters =
            options_.shooters * brightness_[j] * hit.distance * hit.distance / cos_there;
        const float rays = float(options_.rays) * density;
        return rays > 0.0f ? rays / (shooters + rays) : 0.0f;
    }

    /// Russian roulette before another lobe: 0, or what makes up for those that end.
    static float survival(const glm::vec3& throughput, const glm::vec3& specular,
                          const glm::vec2& random)
    {
        const glm::vec3 next = throughput * specular;
        const float chance = std::min(std::max({next.x, next.y, next.z}), 1.0f);
        return random.x < chance ? 1.0f / chance : 0.0f;
    }

    const RayScene& rays_;
    const Surfaces& surfaces_;
    const LitScene& lit_;
    std::span<const float> brightness_;
    LobeRayOptions options_;
    float lift_;  ///< [m]
};

}  // namespace

std::vector<glm::vec3> gather_along_lobes(std::span<const EyePoint> points, const RayScene& rays,
                                          const Surfaces& surfaces, const LitScene& lit,
                                          std::span<const float> brightness,
                                          const LobeRayOptions& options,
                                          const std::function<bool(double)>& progress)
{
    const LobeRays lobes(rays, surfaces, lit, brightness, options);
    std::vector<glm::vec3> radiance(points.size(), glm::vec3(0.0f));
    // One ray of every point at a time: weighed for as many as were asked for, fewer are as right.
    std::uint32_t taken = 0;
    for (bool stopped = false; taken < options.rays && !stopped; ++taken) {
        const auto follow = [&](std::size_t first, std::size_t last) {
            for (std::size_t e = first; e < last; ++e) {
                const std::uint32_t stream = PathSamples::hash(options.seed, std::uint32_t(e));
                radiance[e] += lobes.estimate(points[e], PathSamples(stream, taken));
            }
        };
        const auto tell = [&](std::size_t done) {
            const double share = double(done) / double(points.size());
            stopped |= progress && !progress((taken + share) / options.rays);
            return true;
        };
        parallel_steps(points.size(), kPointsPerStep, kPointsPerTask, follow, tell);
    }
    for (glm::vec3& sum : radiance)
        sum /= float(std::max(taken, 1u));
    return radiance;
}

}  // namespace lumel
