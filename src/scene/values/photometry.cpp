// Luminous intensity of point and spot lights over directions.

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <glm/gtc/constants.hpp>

#include "scene/values/scene.h"

namespace lumel {
namespace {

/// Direction in the light's frame, without its scale.
glm::vec3 into_frame(const glm::mat4& transform, const glm::vec3& direction)
{
    return {glm::dot(glm::normalize(glm::vec3(transform[0])), direction),
            glm::dot(glm::normalize(glm::vec3(transform[1])), direction),
            glm::dot(glm::normalize(glm::vec3(transform[2])), direction)};
}

/// KHR_lights_punctual's recommended falloff between the two cones.
float cone(const PunctualLight& light, float cosine)
{
    const float edge = std::cos(light.outer_cone);
    const float width = std::max(kMinConeStep, std::cos(light.inner_cone) - edge);
    const float share = std::clamp((cosine - edge) / width, 0.0f, 1.0f);
    return share * share;
}

float candela_towards(const Photometry& profile, const glm::vec3& local)
{
    constexpr int kAzimuths = Photometry::kAzimuthSteps;
    constexpr int kPolars = Photometry::kPolarSteps;
    const float polar = std::acos(std::clamp(-local.z, -1.0f, 1.0f)) / glm::pi<float>() * kPolars;
    const float turn = std::atan2(local.y, local.x) / glm::two_pi<float>() * kAzimuths;
    const float azimuth = turn < 0.0f ? turn + float(kAzimuths) : turn;
    const int row = std::min(int(polar), kPolars - 1);
    const int column = std::min(int(azimuth), kAzimuths - 1);
    const auto value = [&](int a, int p) {
        return profile.candela[std::size_t(a % kAzimuths) * (kPolars + 1) + std::size_t(p)];
    };
    const float along = polar - float(row);
    const float around = azimuth - float(column);
    return glm::mix(glm::mix(value(column, row), value(column, row + 1), along),
                    glm::mix(value(column + 1, row), value(column + 1, row + 1), along), around);
}

}  // namespace

bool shines(const PunctualLight& light)
{
    return light.intensity > 0.0f && light.color != glm::vec3(0.0f);
}

glm::vec3 intensity_towards(const Scene& scene, const PunctualLight& light,
                            const glm::vec3& direction)
{
    const glm::vec3 local = into_frame(light.transform, direction);
    glm::vec3 intensity = light.color * light.intensity;
    if (light.kind == PunctualLight::Kind::spot)
        intensity *= cone(light, -local.z);
    if (light.profile >= 0)
        intensity *= candela_towards(scene.profiles[std::size_t(light.profile)], local);
    return intensity;
}

float range_window(const PunctualLight& light, float distance)
{
    if (light.range <= 0.0f)
        return 1.0f;
    const float ratio = distance / light.range;
    return std::clamp(1.0f - ratio * ratio * ratio * ratio, 0.0f, 1.0f);
}

}  // namespace lumel
