// Path tracing with next-event estimation and multiple importance sampling.
//
// [Kaj86] J. Kajiya, The Rendering Equation, 1986.
// [VG95]  E. Veach, L. Guibas, Optimally Combining Sampling Techniques, 1995.
//
// With H the irradiance, L the emitted luminance and ρ the albedo at a point,
//
//     H(x) = ∫ (L(y) + ρ(y)/π H(y)) cosθ dω,       y what x sees along ω.
//
// One cosine-distributed direction estimates it as  π L(y) + ρ(y) H(y); a point z drawn on an
// emitter estimates its L part a second time, and the power heuristic weighs the two:
//
//     H(x) ≈ direct(x, z) + π w L(y) + ρ(y) H(y).

#include "reference/reference.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "atlas/sampling.h"
#include "core/parallel.h"
#include "reference/emitters.h"
#include "reference/samples.h"
#include "reference/surfaces.h"

namespace lumel {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Path starts are lifted off their surface by this share of the scene's size: far above the
/// rounding of a hit's position (about 1e-7 of it), far below anything one could see.
constexpr float kLift = 1e-5f;
/// Bounces that draw stratified numbers; later ones add too little for it to pay.
constexpr int kStratifiedBounces = 1;
/// Throughput below which a path takes part in Russian roulette. Measured on the Cornell box:
/// 1 costs twice as much time for the same error, 0.1 a fifth more.
constexpr float kRouletteBelow = 0.25f;
/// Samples of a lumel taken in one go, between two progress reports.
constexpr int kSamplesPerPass = 16;
/// Lumels between two progress reports.
constexpr std::size_t kLumelsPerPass = 8192;
/// Fewest lumels worth a task.
constexpr std::size_t kLumelsPerTask = 16;

/// Where a path stands, lifted off the surface, on the side it may look to.
struct Stand {
    glm::vec3 position;
    glm::vec3 geometric;  ///< unit normal of the triangle
    glm::vec3 normal;     ///< shading normal, which cosines are taken with
};

/// A unit direction with density cosθ / π about `normal`.
glm::vec3 cosine_direction(const glm::vec3& normal, const glm::vec2& at)
{
    // Concentric map of the square to the disc, which keeps strata compact.
    const glm::vec2 offset = 2.0f * at - 1.0f;
    glm::vec2 disc(0.0f);
    if (std::abs(offset.x) > std::abs(offset.y)) {
        const float angle = kPi / 4.0f * (offset.y / offset.x);
        disc = offset.x * glm::vec2(std::cos(angle), std::sin(angle));
    } else if (offset.y != 0.0f) {
        const float angle = kPi / 2.0f - kPi / 4.0f * (offset.x / offset.y);
        disc = offset.y * glm::vec2(std::cos(angle), std::sin(angle));
    }
    // Branch-free tangent frame. [DBC*17] T. Duff et al., Building an Orthonormal Basis, 2017
    const float sign = std::copysign(1.0f, normal.z);
    const float a = -1.0f / (sign + normal.z);
    const float b = normal.x * normal.y * a;
    const glm::vec3 tangent(1.0f + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
    const glm::vec3 bitangent(b, sign + normal.y * normal.y * a, -normal.y);
    const float height = std::sqrt(std::max(0.0f, 1.0f - glm::dot(disc, disc)));
    return disc.x * tangent + disc.y * bitangent + height * normal;
}

/// Veach's power heuristic (β = 2) for a sample drawn with density `mine`. [VG95]
float power_heuristic(float mine, float other)
{
    return mine * mine / (mine * mine + other * other);
}

class PathTracer {
public:
    PathTracer(const Scene& scene, const RayScene& rays, const Lumels& lumels,
               const ReferenceOptions& options)
        : rays_(rays),
          lumels_(lumels),
          options_(options),
          surfaces_(scene),
          emitters_(surfaces_)
    {
        const glm::vec3 low = rays.low(), high = rays.high();
        const glm::vec3 reach = glm::max(glm::abs(low), glm::abs(high));
        lift_ = kLift * std::max(glm::length(high - low), std::max({reach.x, reach.y, reach.z}));
        for (const Instance& instance : scene.instances) {
            transforms_.push_back(instance.transform);
            normal_transforms_.push_back(
                glm::transpose(glm::inverse(glm::mat3(instance.transform))));
        }
    }

    /// One estimate of H [lx] of a lumel.
    glm::vec3 estimate(std::size_t lumel, std::uint32_t sample) const
    {
        const std::uint32_t stream =
            PathSamples::hash(PathSamples::hash(options_.seed, 0), std::uint32_t(lumel));
        const PathSamples samples(stream, sample);
        return irradiance(start(lumels_.lumels[lumel], samples.stratified(0)), samples);
    }

private:
    Stand start(const Lumel& lumel, const glm::vec2& at) const;
    glm::vec3 irradiance(Stand stand, const PathSamples& samples) const;
    glm::vec3 direct(const Stand& stand, const glm::vec2& at, std::uint32_t seed) const;

    const RayScene& rays_;
    const Lumels& lumels_;
    ReferenceOptions options_;
    Surfaces surfaces_;
    Emitters emitters_;
    float lift_ = 0.0f;  ///< [m]
    std::vector<glm::mat4> transforms_;
    std::vector<glm::mat3> normal_transforms_;
};

/// Steps onto a lumel, in the world.
Stand PathTracer::start(const Lumel& lumel, const glm::vec2& at) const
{
    glm::vec3 position = lumel.position;
    glm::vec3 normal = lumel.normal;
    glm::vec3 geometric = lumel.normal;
    if (options_.rule == SampleRule::area) {
        const LumelPoint point = point_on(lumels_, lumel, at.x, at.y);
        position = point.position;
        normal = point.normal;
        std::uint32_t piece = lumel.first_piece;
        while (piece + 1 < lumel.first_piece + lumel.piece_count &&
               at.x >= lumels_.pieces[piece].share)
            ++piece;
        geometric = glm::cross(lumels_.pieces[piece].edge_u, lumels_.pieces[piece].edge_v);
    }
    const glm::mat3& normal_transform = normal_transforms_[lumel.instance];
    Stand stand;
    stand.geometric = glm::normalize(normal_transform * geometric);
    stand.normal = glm::normalize(normal_transform * normal);
    // Lean towards the middle too, so that no start lies behind a wall that touches the lumel.
    const glm::mat4& transform = transforms_[lumel.instance];
    const glm::vec3 world(transform * glm::vec4(position, 1.0f));
    const glm::vec3 inward = glm::vec3(transform * glm::vec4(lumel.position, 1.0f)) - world;
    const float way = glm::length(inward);
    stand.position = world + lift_ * stand.geometric;
    if (way > 0.0f)
        stand.position += inward * (std::min(lift_, 0.5f * way) / way);
    return stand;
}

/// Light straight from one point drawn on the emitters, weighed against finding it by chance.
glm::vec3 PathTracer::direct(const Stand& stand, const glm::vec2& at, std::uint32_t seed) const
{
    const EmitterPoint emitter = emitters_.sample(at);
    const glm::vec3 way = emitter.position - stand.position;
    const float squared = glm::dot(way, way);
    const glm::vec3 direction = way / std::sqrt(squared);
    const float cos_here = glm::dot(stand.normal, direction);
    const float cos_front = -glm::dot(emitter.normal, direction);
    const float cos_there = emitter.double_sided ? std::abs(cos_front) : cos_front;
    if (!(cos_here > 0.0f) || !(cos_there > 0.0f) || glm::dot(stand.geometric, direction) <= 0.0f)
        return glm::vec3(0.0f);

    const glm::vec3 lifted =
        emitter.position + (cos_front > 0.0f ? lift_ : -lift_) * emitter.normal;
    if (!rays_.sees(stand.position, lifted, 0.0f, seed))
        return glm::vec3(0.0f);
    const float density = emitter.density * squared / cos_there;  // per solid angle
    return emitter.luminance * (cos_here / density * power_heuristic(density, cos_here / kPi));
}

/// Follows one path. [Kaj86]
glm::vec3 PathTracer::irradiance(Stand stand, const PathSamples& samples) const
{
    glm::vec3 gathered(0.0f);
    glm::vec3 throughput(1.0f);
    for (int bounce = 0; bounce <= options_.max_bounces; ++bounce) {
        const std::uint32_t pair = 1 + 4 * std::uint32_t(bounce);
        const auto draw = [&](std::uint32_t p) {
            return bounce < kStratifiedBounces ? samples.stratified(p) : samples.random(p);
        };
        // See an emitter.
        if (!emitters_.empty())
            gathered += throughput * direct(stand, draw(pair), samples.bits(pair));

        // See whatever is there.
        const glm::vec3 direction = cosine_direction(stand.normal, draw(pair + 1));
        const float cos_here = glm::dot(stand.normal, direction);
        RayHit hit;
        if (glm::dot(stand.geometric, direction) <= 0.0f || !(cos_here > 0.0f) ||
            !rays_.closest(stand.position, direction, 0.0f, std::numeric_limits<float>::max(),
                           samples.bits(pair + 1), hit))
            break;
        const Shading shading = surfaces_.shade(hit);
        if (shading.luminance != glm::vec3(0.0f)) {
            const float cos_there = -glm::dot(shading.geometric, direction);
            const float density =
                emitters_.density(surfaces_.index(hit.instance, hit.primitive), hit.triangle) *
                hit.distance * hit.distance / cos_there;
            gathered +=
                throughput * shading.luminance * (kPi * power_heuristic(cos_here / kPi, density));
        }

        // Go on from there, or stop by Russian roulette.
        throughput *= shading.albedo;
        const float strongest = std::max({throughput.x, throughput.y, throughput.z});
        if (!(strongest > 0.0f))
            break;
        if (strongest < kRouletteBelow) {
            const float survival = strongest / kRouletteBelow;
            if (samples.random(pair + 2).x >= survival)
                break;
            throughput /= survival;
        }
        stand.position = stand.position + direction * std::max(0.0f, hit.distance - lift_) +
                         lift_ * shading.geometric;
        stand.geometric = shading.geometric;
        stand.normal = shading.normal;
    }
    return gathered;
}

}  // namespace

std::vector<glm::vec3> reference_irradiance(const Scene& scene, const RayScene& rays,
                                            const Lumels& lumels, const ReferenceOptions& options,
                                            const std::function<bool(double)>& progress)
{
    const PathTracer tracer(scene, rays, lumels, options);
    const std::size_t count = lumels.lumels.size();
    std::vector<glm::dvec3> sums(count, glm::dvec3(0.0));
    std::vector<int> taken(count, 0);

    // Pass over all lumels a few samples at a time, so that a stopped run is a noisier whole map.
    bool stopped = false;
    for (int done = 0; done < options.samples_per_lumel && !stopped; done += kSamplesPerPass) {
        const int until = std::min(done + kSamplesPerPass, options.samples_per_lumel);
        for (std::size_t begin = 0; begin < count && !stopped; begin += kLumelsPerPass) {
            const std::size_t width = std::min(kLumelsPerPass, count - begin);
            parallel_for(width, kLumelsPerTask, [&](std::size_t first, std::size_t last) {
                for (std::size_t i = begin + first; i < begin + last; ++i) {
                    if ((lumels.lumels[i].flags & kLumelBuried) == 0)
                        for (int sample = done; sample < until; ++sample)
                            sums[i] += glm::dvec3(tracer.estimate(i, std::uint32_t(sample)));
                    taken[i] = until;
                }
            });
            const double share = (double(begin + width) / double(count) * (until - done) + done) /
                                 options.samples_per_lumel;
            stopped = progress && !progress(share);
        }
    }

    std::vector<glm::vec3> irradiance(count, glm::vec3(0.0f));
    for (std::size_t i = 0; i < count; ++i)
        if (taken[i] > 0)
            irradiance[i] = glm::vec3(sums[i] / double(taken[i]));
    return irradiance;
}

}  // namespace lumel
