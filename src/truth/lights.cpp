// Next-event estimation: shadow rays to points sampled on light sources. Emitters and the sky,
// which reflected directions can hit as well, are estimated twice and weighted by the power
// heuristic; lamps are never hit.
//
// [VG95] E. Veach, L. Guibas, Optimally Combining Sampling Techniques, 1995.

#include "truth/lights.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/core/luminance.h"
#include "rays/paths/directions.h"

namespace lumel {

namespace {

/// Shadow rays to lamps per bounce. In rooms and streets of 4 to 200 lamps 1 to 4 cost about the
/// same for equal error, and one for every lamp up to twice as much.
constexpr std::size_t kLampRays = 2;
/// The sky is sampled if its mean squared radiance exceeds this multiple of its squared mean. In
/// streets that pays from 2 to 3 on; reflected directions suffice for more uniform skies.
constexpr double kUnevenSky = 2.5;

/// Veach's power heuristic (β = 2) for a sample drawn with density `mine`. [VG95]
float power_heuristic(float mine, float other)
{
    const float ratio = other / mine;  // not of squares, which can overflow
    return 1.0f / (1.0f + ratio * ratio);
}

/// True if sampling the bright parts of the sky pays.
bool is_uneven(const Sky& sky)
{
    double angle = 0.0, mean = 0.0, squares = 0.0;
    for (int row = 0; row < sky.height; ++row) {
        const double texel = sky_texel_angle(sky, row);
        for (int column = 0; column < sky.width; ++column) {
            const double radiance = sum_of(
                sky.radiance[std::size_t(row) * std::size_t(sky.width) + std::size_t(column)]);
            angle += texel;
            mean += texel * radiance;
            squares += texel * radiance * radiance;
        }
    }
    return squares * angle > kUnevenSky * mean * mean;
}

}  // namespace

Lights::Lights(const Scene& scene, const RayScene& rays, const Surfaces& surfaces)
    : rays_(rays),
      surfaces_(surfaces),
      sky_(scene.sky),
      emitters_(surfaces),
      lamps_(scene)
{
    if (is_uneven(sky_))
        sky_sampler_.emplace(sky_);
}

glm::vec3 Lights::from_emitter(const PathVertex& vertex, const BounceSamples& samples) const
{
    const EmitterPoint emitter = emitters_.sample(samples.point(Draw::emitter));
    const glm::vec3 offset = emitter.position - vertex.position;
    const float squared = glm::dot(offset, offset);
    const float distance = std::sqrt(squared);
    const glm::vec3 direction = offset / distance;
    const float cos_here = cosine_above(vertex, direction);
    const float cos_front = -glm::dot(emitter.normal, direction);
    const float cos_there = emitter.double_sided ? std::abs(cos_front) : cos_front;
    if (!(cos_here > 0.0f) || !(cos_there > 0.0f))
        return glm::vec3(0.0f);

    const float ray_offset = ray_offset_for(std::max(emitter.reach, distance));
    const glm::vec3 lifted =
        emitter.position + (cos_front > 0.0f ? ray_offset : -ray_offset) * emitter.normal;
    const glm::vec3 transmittance =
        rays_.transmittance(vertex.position, lifted, 0.0f, samples.bits(Draw::emitter));
    if (transmittance == glm::vec3(0.0f))
        return transmittance;
    const float density = emitter.density * squared / cos_there;  // per solid angle
    const Brdf::Response response = vertex.brdf.respond(direction);
    const float weight = power_heuristic(density, response.density);
    return transmittance * emitter.luminance * (response.shape * (cos_here / density * weight));
}

glm::vec3 Lights::from_sky(const PathVertex& vertex, const BounceSamples& samples) const
{
    const SkySample sky = sky_sampler_->sample(samples.point(Draw::sky));
    const float cosine = cosine_above(vertex, sky.direction);
    if (!(cosine > 0.0f) || !(sky.density > 0.0f))
        return glm::vec3(0.0f);
    const glm::vec3 transmittance =
        rays_.transmittance_out(vertex.position, sky.direction, samples.bits(Draw::sky));
    if (transmittance == glm::vec3(0.0f))
        return transmittance;
    const Brdf::Response response = vertex.brdf.respond(sky.direction);
    const float weight = power_heuristic(sky.density, response.density);
    return transmittance * sky.radiance * (response.shape * (cosine / sky.density * weight));
}

/// Computes the unoccluded light of every lamp, and traces shadow rays to a few, selected by it.
glm::vec3 Lights::from_lamps(const PathVertex& vertex, const BounceSamples& samples) const
{
    struct Offer {
        LampSample lamp;
        glm::vec3 light;
        float running;  ///< cumulative light
    };
    std::vector<Offer> offers;
    offers.reserve(lamps_.count());
    const glm::vec2 disc = square_to_disc(samples.point(Draw::lamp));
    float total = 0.0f;
    for (std::size_t i = 0; i < lamps_.count(); ++i) {
        const LampSample lamp = lamps_.sample(i, vertex.position, disc);
        const float cosine = cosine_above(vertex, lamp.direction);
        if (!(cosine > 0.0f) || lamp.illuminance == glm::vec3(0.0f))
            continue;
        const glm::vec3 light =
            lamp.illuminance * (vertex.brdf.respond(lamp.direction).shape * cosine);
        total += sum_of(light);
        offers.push_back({lamp, light, total});
    }
    const auto arrives = [&](const LampSample& lamp) {
        return transmittance(rays_, vertex.position, lamp, 0.0f, samples.bits(Draw::lamp));
    };

    glm::vec3 arriving(0.0f);
    if (offers.size() <= kLampRays) {
        for (const Offer& offer : offers)
            arriving += arrives(offer.lamp) * offer.light;
        return arriving;
    }
    const float step = total / float(kLampRays);
    float mark = samples.point(Draw::lamp_choice).x * step;
    for (const Offer& offer : offers)
        for (; mark < offer.running; mark += step)
            arriving += arrives(offer.lamp) * offer.light * (step / sum_of(offer.light));
    return arriving;
}

glm::vec3 Lights::met(const RayHit& hit, const Shading& shading, const glm::vec3& direction,
                      float density) const
{
    const float cos_there = -glm::dot(shading.geometric, direction);
    const float sought =
        emitters_.density(surfaces_.index(hit.instance, hit.primitive), hit.triangle) *
        hit.distance * hit.distance / cos_there;
    return shading.luminance * power_heuristic(density, sought);
}

glm::vec3 Lights::met_sky(const glm::vec3& direction, float density) const
{
    const float sought = sky_sampler_ ? sky_sampler_->density(direction) : 0.0f;
    return sky_radiance(sky_, direction) * power_heuristic(density, sought);
}

std::optional<glm::vec3> Lights::background(const glm::vec3& direction) const
{
    if (sky_.empty())
        return {};
    return sky_radiance(sky_, direction);
}

}  // namespace lumel
