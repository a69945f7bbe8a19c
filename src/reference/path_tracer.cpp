// Path tracing with next-event estimation and multiple importance sampling.
//
// [Kaj86] J. Kajiya, The Rendering Equation, 1986.
// [VG95]  E. Veach, L. Guibas, Optimally Combining Sampling Techniques, 1995.
//
// What a point x of reflectance ρ = ρ_d + ρ_s reflects along ω, times π, is
//
//     R(x, ω) = ρ ∫ s(ω, ω') (L(y) + R(y, -ω') / π) cosθ' dω',      s = π f_r / ρ,
//
// y being what x sees along ω', and L the emitted luminance. For white matte, s = ρ = 1 and R is
// the irradiance. A direction ω' of density p estimates it as  ρ s cosθ'/(π p) · (π L(y) + R(y));
// a point z drawn on an emitter estimates its L part a second time, and the power heuristic weighs
// the two:
//
//     R(x) ≈ ρ (direct(x, z) + s cosθ'/(π p) · (π w L(y) + R(y))).

#include "reference/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace lumel {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
/// Bounces that draw stratified numbers; later ones add too little for it to pay.
constexpr int kStratifiedBounces = 1;
/// Pairs of random numbers that each bounce may draw.
constexpr std::uint32_t kPairsPerBounce = 4;
/// Throughput below which a path takes part in Russian roulette. Measured on the Cornell box:
/// 1 costs twice as much time for the same error, 0.1 a fifth more.
constexpr float kRouletteBelow = 0.25f;
constexpr float kFar = std::numeric_limits<float>::max();

/// Veach's power heuristic (β = 2) for a sample drawn with density `mine`. [VG95]
float power_heuristic(float mine, float other)
{
    const float ratio = other / mine;  // not of squares, which may be too large for a float
    return 1.0f / (1.0f + ratio * ratio);
}

/// Stops a path that carries little by Russian roulette, or makes it carry more. False: stopped.
bool goes_on(glm::vec3& throughput, float at)
{
    const float strongest = std::max({throughput.x, throughput.y, throughput.z});
    if (!(strongest > 0.0f))
        return false;
    if (strongest >= kRouletteBelow)
        return true;
    const float survival = strongest / kRouletteBelow;
    throughput /= survival;
    return at < survival;
}

}  // namespace

PathTracer::PathTracer(const Scene& scene, const RayScene& rays, int max_bounces)
    : rays_(rays),
      surfaces_(scene),
      emitters_(surfaces_),
      max_bounces_(max_bounces),
      lift_(rays.lift())
{
}

/// Steps onto what a ray hit.
Stand PathTracer::land(const glm::vec3& origin, const glm::vec3& direction, float distance,
                       const Shading& shading) const
{
    return {origin + direction * std::max(0.0f, distance - lift_) + lift_ * shading.geometric,
            shading.geometric, Brdf(shading.reflectance, shading.normal, -direction)};
}

/// Light straight from one point drawn on the emitters, weighed against finding it by chance.
glm::vec3 PathTracer::direct(const Stand& stand, const glm::vec2& at, std::uint32_t seed) const
{
    const EmitterPoint emitter = emitters_.sample(at);
    const glm::vec3 way = emitter.position - stand.position;
    const float squared = glm::dot(way, way);
    const glm::vec3 direction = way / std::sqrt(squared);
    const float cos_here = glm::dot(stand.brdf.normal(), direction);
    const float cos_front = -glm::dot(emitter.normal, direction);
    const float cos_there = emitter.double_sided ? std::abs(cos_front) : cos_front;
    if (!(cos_here > 0.0f) || !(cos_there > 0.0f) || glm::dot(stand.geometric, direction) <= 0.0f)
        return glm::vec3(0.0f);

    const glm::vec3 lifted =
        emitter.position + (cos_front > 0.0f ? lift_ : -lift_) * emitter.normal;
    if (!rays_.sees(stand.position, lifted, 0.0f, seed))
        return glm::vec3(0.0f);
    const float density = emitter.density * squared / cos_there;  // per solid angle
    const Brdf::Response response = stand.brdf.respond(direction);
    const float weight = power_heuristic(density, response.density);
    return emitter.luminance * (response.shape * (cos_here / density * weight));
}

/// Follows one path. [Kaj86]
glm::vec3 PathTracer::reflected(Stand stand, const PathSamples& samples) const
{
    glm::vec3 gathered(0.0f);
    glm::vec3 throughput = stand.brdf.reflectance();
    for (int bounce = 0; bounce <= max_bounces_; ++bounce) {
        const std::uint32_t pair = kStartPair + 1 + kPairsPerBounce * std::uint32_t(bounce);
        const auto draw = [&](std::uint32_t p) {
            return bounce < kStratifiedBounces ? samples.stratified(p) : samples.random(p);
        };
        // See an emitter.
        if (!emitters_.empty())
            gathered += throughput * direct(stand, draw(pair), samples.bits(pair));

        // See whatever is there.
        const glm::vec3 direction = stand.brdf.sample(draw(pair + 1));
        const float cos_here = glm::dot(stand.brdf.normal(), direction);
        RayHit hit;
        if (glm::dot(stand.geometric, direction) <= 0.0f || !(cos_here > 0.0f) ||
            !rays_.closest(stand.position, direction, 0.0f, kFar, samples.bits(pair + 1), hit))
            break;
        const Brdf::Response response = stand.brdf.respond(direction);
        if (!(response.density > 0.0f))
            break;
        throughput *= response.shape * (cos_here / kPi / response.density);
        const Shading shading = surfaces_.shade(hit);
        if (shading.luminance != glm::vec3(0.0f)) {
            const float cos_there = -glm::dot(shading.geometric, direction);
            const float density =
                emitters_.density(surfaces_.index(hit.instance, hit.primitive), hit.triangle) *
                hit.distance * hit.distance / cos_there;
            gathered +=
                throughput * shading.luminance * (kPi * power_heuristic(response.density, density));
        }

        // Go on from there.
        stand = land(stand.position, direction, hit.distance, shading);
        throughput *= stand.brdf.reflectance();
        if (!goes_on(throughput, samples.random(pair + 2).x))
            break;
    }
    return gathered;
}

std::optional<glm::vec3> PathTracer::radiance(const glm::vec3& origin, const glm::vec3& direction,
                                              const PathSamples& samples) const
{
    RayHit hit;
    if (!rays_.closest(origin, direction, 0.0f, kFar, samples.bits(kStartPair), hit))
        return {};
    const Shading shading = surfaces_.shade(hit);
    const Stand stand = land(origin, direction, hit.distance, shading);
    if (stand.brdf.reflectance() == glm::vec3(0.0f))
        return shading.luminance;
    return shading.luminance + reflected(stand, samples) / kPi;
}

}  // namespace lumel
