// Path tracing with next-event estimation and multiple importance sampling.
//
// [Kaj86] J. Kajiya, The Rendering Equation, 1986.
//
// The light that a point x of reflectance ρ = ρ_d + ρ_s reflects along ω, times π, is
//
//     R(x, ω) = ρ ∫ s(ω, ω') (L(y) + R(y, -ω') / π) cosθ' dω',      s = π f_r / ρ,
//
// where x sees y along ω', and L is the luminance emitted there or the radiance of the sky. For
// white diffuse, s = ρ = 1 and R is the irradiance. A direction ω' of density p estimates it as ρ s
// cosθ'/(π p) · (π L(y) + R(y)). Shadow rays to points z sampled on light sources estimate the L
// part a second time, with weights that sum to 1 (lights.cpp), and add the lamps, which ω' never
// hits:
//
//     R(x) ≈ ρ (sought(x, z) + s cosθ'/(π p) · (π w L(y) + R(y))).
//
// Direct light of x is the L of its own first step and its lamps; the rest is indirect.

#include "truth/path_tracer.h"

#include <algorithm>
#include <limits>

#include "base/core/pi.h"

namespace lumel {

namespace {

/// Throughput below which a path takes part in Russian roulette. On the Cornell box, 1 costs twice
/// as much time for the same error, 0.1 a fifth more.
constexpr float kRouletteBelow = 0.25f;
constexpr float kFar = std::numeric_limits<float>::max();

/// Russian roulette for paths of low throughput. Returns false if the path ends.
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

PathTracer::PathTracer(const Scene& scene, const RayScene& rays, int max_bounces, Parts parts)
    : rays_(rays),
      surfaces_(scene),
      lights_(scene, rays, surfaces_),
      first_bounce_(parts == Parts::indirect ? 1 : 0),
      last_bounce_(parts == Parts::direct ? 0 : max_bounces)
{
}

/// The path vertex at a hit.
PathVertex PathTracer::land(const glm::vec3& origin, const glm::vec3& direction, const RayHit& hit,
                            const Shading& shading)
{
    return {origin + direction * std::max(0.0f, hit.distance - hit.ray_offset) +
                hit.ray_offset * shading.geometric,
            shading.geometric, Brdf(shading.reflectance, shading.normal, -direction)};
}

/// Traces one path. [Kaj86]
glm::vec3 PathTracer::reflected(PathVertex vertex, const PathSamples& path) const
{
    glm::vec3 gathered(0.0f);
    glm::vec3 throughput = vertex.brdf.reflectance();
    for (int bounce = 0; bounce <= last_bounce_; ++bounce) {
        const BounceSamples samples(path, bounce);
        const bool counts = bounce >= first_bounce_;
        if (counts)
            gathered += throughput * lights_.sought(vertex, samples);

        const glm::vec3 direction = vertex.brdf.sample(samples.point(Draw::direction));
        const float cosine = cosine_above(vertex, direction);
        if (!(cosine > 0.0f))
            break;
        RayHit hit;
        const bool met = rays_.closest(vertex.position, direction, 0.0f, kFar,
                                       samples.bits(Draw::direction), hit);
        const Brdf::Response response = vertex.brdf.respond(direction);
        if (!(response.density > 0.0f))
            break;
        throughput *= hit.tint * (response.shape * (cosine / kPi / response.density));
        if (!met) {
            if (counts)
                gathered += kPi * throughput * lights_.met_sky(direction, response.density);
            break;
        }
        const Shading shading = surfaces_.shade(hit);
        if (counts && shading.luminance != glm::vec3(0.0f))
            gathered += kPi * throughput * lights_.met(hit, shading, direction, response.density);

        // Continues from there.
        vertex = land(vertex.position, direction, hit, shading);
        throughput *= vertex.brdf.reflectance();
        if (!goes_on(throughput, samples.number(Draw::roulette)))
            break;
    }
    return gathered;
}

std::optional<glm::vec3> PathTracer::radiance(const glm::vec3& origin, const glm::vec3& direction,
                                              const PathSamples& samples) const
{
    RayHit hit;
    if (!rays_.closest(origin, direction, 0.0f, kFar, samples.bits(kStartPair), hit)) {
        const std::optional<glm::vec3> sky = lights_.background(direction);
        return sky ? hit.tint * *sky : sky;
    }
    const Shading shading = surfaces_.shade(hit);
    const PathVertex vertex = land(origin, direction, hit, shading);
    if (vertex.brdf.reflectance() == glm::vec3(0.0f))
        return hit.tint * shading.luminance;
    return hit.tint * (shading.luminance + reflected(vertex, samples) / kPi);
}

}  // namespace lumel
