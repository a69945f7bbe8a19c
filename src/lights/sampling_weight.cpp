// Sampling weights of light sources.
//
// [CEK18] A. Conty Estevez, C. Kulla. Importance Sampling of Many Lights with Adaptive Tree
//         Splitting. HPG 2018.

#include "lights/sources.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/core/luminance.h"
#include "base/core/pi.h"

namespace lumel {
namespace {

/// Minimum cosines and intensities in sampling weights, relative to the most: they are those of
/// bounds or of one direction, and others may have more.
constexpr float kLeastGuess = 1.0f / 16.0f;
/// Of the angle to a spot's axis, for rounding [rad].
constexpr float kConeSlack = 1e-4f;

/// Height of the highest point of a box over a plane [m].
float height_over(const glm::vec3& point, const glm::vec3& normal, const Box& box)
{
    const glm::vec3 half = 0.5f * (box.high - box.low);
    return glm::dot(normal, box.centre() - point) + glm::dot(glm::abs(normal), half);
}

/// Bound on the cosine at a plane towards a box at a distance; 0: the box is below it. normal: 0
/// for a plane that faces all sides.
float cosine_towards(const glm::vec3& point, const glm::vec3& normal, const Box& box,
                     float distance)
{
    if (normal == glm::vec3(0.0f))
        return 1.0f;
    const float height = height_over(point, normal, box);
    if (!(height > 0.0f))
        return 0.0f;
    return height < distance ? std::max(height / distance, kLeastGuess) : 1.0f;
}

}  // namespace

Receiver receiver_of(const WorldLumels& world, std::size_t i)
{
    const WorldLumel& lumel = world[i];
    constexpr float kFar = std::numeric_limits<float>::infinity();
    Receiver receiver{{glm::vec3(kFar), glm::vec3(-kFar)},
                      lumel.centre,
                      lumel.flat ? lumel.normal : glm::vec3(0.0f)};
    for (const Facet* facet = world.begin(lumel); facet != world.end(lumel); ++facet)
        for (int c = 0; c < facet->count; ++c) {
            receiver.box.low = glm::min(receiver.box.low, facet->corner[c]);
            receiver.box.high = glm::max(receiver.box.high, facet->corner[c]);
        }
    return receiver;
}

/// Bound on the light of a lamp, relative to that of its brightest direction. apart: distance at
/// least [m].
float LightSources::lamp_weight(const Source& source, const Receiver& receiver, float apart) const
{
    const PunctualLight& light = scene_->lights[source.first];
    if (light.range > 0.0f && apart >= light.range)
        return 0.0f;
    const glm::vec3 offset = receiver.box.centre() - source.centre;
    const float distance = glm::length(offset), reach = source.radius + receiver.box.radius();
    if (!(distance > reach))
        return 1.0f;
    const glm::vec3 direction = offset / distance;
    if (light.kind == PunctualLight::Kind::spot) {
        const float from_axis = std::acos(std::clamp(
            glm::dot(direction, -glm::normalize(glm::vec3(light.transform[2]))), -1.0f, 1.0f));
        if (from_axis - std::asin(reach / distance) > light.outer_cone + kConeSlack)
            return 0.0f;
    }
    const double here = luminance(intensity_towards(*scene_, light, direction));
    return std::max(float(here / source.power), kLeastGuess);
}

float LightSources::sampling_weight(std::size_t index, const Receiver& receiver) const
{
    const Source& source = sources_[index];
    const glm::vec3 at = receiver.box.centre();
    if (source.kind == Kind::sky)
        return float(source.power);
    if (source.kind == Kind::sun) {
        const PunctualLight& sun = scene_->lights[source.first];
        const glm::vec3 towards = glm::normalize(glm::vec3(sun.transform[2]));
        const Box disc = Box{towards, towards}.grown(std::sin(sun.angle));
        return float(source.power) * cosine_towards(glm::vec3(0.0f), receiver.normal, disc, 1.0f);
    }
    const float reach = source.radius + receiver.box.radius();
    const float apart = std::max(glm::distance(at, source.centre) - reach, 0.0f);
    // Within the bounding radius, uses the light at half of it.
    const float squared = std::max(apart * apart, 0.25f * reach * reach);
    const float here = float(source.power) / squared *
                       cosine_towards(receiver.point, receiver.normal, source.box, apart);
    if (!(here > 0.0f))
        return 0.0f;
    if (source.kind == Kind::lamp)
        return here * lamp_weight(source, receiver, apart);
    const glm::vec3& on_source = triangles_[source.first].corner[0];
    return here / kPi * cosine_towards(on_source, source.normal, receiver.box, apart);
}

}  // namespace lumel
