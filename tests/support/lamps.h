#pragma once
// Lights for small scenes made by hand.

#include "scene/values/scene.h"

namespace lumel::support {

/// A light at a place that shines along a direction.
inline PunctualLight make_lamp(PunctualLight::Kind kind, float intensity, const glm::vec3& position,
                               const glm::vec3& along = {0.0f, 0.0f, -1.0f})
{
    PunctualLight light;
    light.kind = kind;
    light.intensity = intensity;
    const glm::vec3 back = -glm::normalize(along);
    const glm::vec3 aside =
        std::abs(back.x) < 0.5f ? glm::vec3(1.0f, 0.0f, 0.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(glm::cross(aside, back));
    light.transform = {glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                       glm::vec4(back, 0.0f), glm::vec4(position, 1.0f)};
    return light;
}

/// The same radiance [cd/m²] from everywhere.
inline Sky even_sky(const glm::vec3& radiance)
{
    return {.width = 1, .height = 1, .radiance = {radiance}};
}

}  // namespace lumel::support
