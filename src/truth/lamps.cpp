// A lamp covers a cone of half angle α: a ball of radius R at distance d with sin α = R / d, or a
// disc in the sky. Directions are sampled uniformly in the cone, whose solid angle is
//
//     Ω = 2π (1 - cos α) = 2π sin² α / (1 + cos α).
//
// The disc has the radiance lux / (π sin² α), so that a plane facing it receives lux. The ball's
// surface emits I(ω) / (π R²) along ω, so that its intensity is I(ω) for any R. Times Ω, the
// estimate for a plane facing the sampled direction is
//
//     disc:  lux · 2 / (1 + cos α),          ball:  I(ω) / d² · 2 / (1 + cos α),
//
// also for α = 0, a point or a parallel beam. Points inside the ball receive nothing.

#include "truth/lamps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rays/paths/directions.h"

namespace lumel {

namespace {

/// A direction sampled in a cone.
struct ConeSample {
    glm::vec3 direction;
    float cosine = 1.0f;        ///< to the axis
    float squared_sine = 0.0f;  ///< exact where it is small
    float spread = 1.0f;        ///< 2 / (1 + cos α)
};

/// Uniform in solid angle, as `disc` is over the unit disc. `squared_sine`: sin² α.
ConeSample draw_from_cone(const glm::vec3& axis, float squared_sine, float cosine,
                          const glm::vec2& disc)
{
    ConeSample ray{.direction = axis};
    if (squared_sine <= 0.0f)
        return ray;
    const float height = squared_sine / (1.0f + cosine);  // 1 - cos α
    const float drop = height * glm::dot(disc, disc);
    ray.cosine = 1.0f - drop;
    ray.squared_sine = drop * (2.0f - drop);
    ray.spread = 2.0f / (1.0f + cosine);
    const glm::vec2 aside = std::sqrt(height * (2.0f - drop)) * disc;
    ray.direction = turn_to(axis, aside.x, aside.y, ray.cosine);
    return ray;
}

}  // namespace

glm::vec3 transmittance(const RayScene& rays, const glm::vec3& position, const LampSample& lamp,
                        float offset, std::uint32_t seed)
{
    return std::isinf(lamp.distance)
               ? rays.transmittance_out(position, lamp.direction, seed)
               : rays.transmittance(position, position + lamp.distance * lamp.direction, offset,
                                    seed);
}

Lamps::Lamps(const Scene& scene) : scene_(&scene)
{
    for (const PunctualLight& light : scene.lights)
        if (shines(light))
            lamps_.push_back({.light = &light,
                              .position = glm::vec3(light.transform[3]),
                              .toward = glm::normalize(glm::vec3(light.transform[2]))});
}

LampSample Lamps::sample(std::size_t lamp, const glm::vec3& position, const glm::vec2& disc) const
{
    const Lamp& chosen = lamps_[lamp];
    return chosen.light->kind == PunctualLight::Kind::directional
               ? from_disc(chosen, disc)
               : from_ball(chosen, position, disc);
}

LampSample Lamps::from_disc(const Lamp& lamp, const glm::vec2& disc) const
{
    const float sine = std::sin(lamp.light->angle);
    const ConeSample ray =
        draw_from_cone(lamp.toward, sine * sine, std::cos(lamp.light->angle), disc);
    return {.direction = ray.direction,
            .distance = std::numeric_limits<float>::infinity(),
            .illuminance = lamp.light->intensity * ray.spread * lamp.light->color};
}

LampSample Lamps::from_ball(const Lamp& lamp, const glm::vec3& position,
                            const glm::vec2& disc) const
{
    const PunctualLight& light = *lamp.light;
    const glm::vec3 offset = lamp.position - position;
    const float squared = glm::dot(offset, offset);
    const float squared_radius = light.radius * light.radius;
    if (squared <= squared_radius)
        return {};
    const float squared_sine = squared_radius / squared;
    const float far = std::sqrt(squared);
    const ConeSample ray =
        draw_from_cone(offset / far, squared_sine, std::sqrt(1.0f - squared_sine), disc);
    // Entry point into the ball.
    const float within = std::sqrt(std::max(0.0f, squared_radius - squared * ray.squared_sine));
    LampSample sample{.direction = ray.direction, .distance = far * ray.cosine - within};
    const float window = range_window(light, sample.distance);
    if (window > 0.0f)
        sample.illuminance =
            intensity_towards(*scene_, light, -ray.direction) * (window * ray.spread / squared);
    return sample;
}

}  // namespace lumel
