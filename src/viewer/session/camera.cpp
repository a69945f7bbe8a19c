#include "viewer/session/camera.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "base/core/error.h"

namespace lumel {
namespace {

constexpr float kSteepest = 0.999f * glm::half_pi<float>();  ///< [rad] maximum with an upright

constexpr float kNearest = 1e-6f;  ///< minimum depth in the image [m]

}  // namespace

std::optional<glm::vec2> place_in_picture(const View& view, const glm::vec3& point)
{
    const glm::vec3 seen(glm::inverse(view.transform) * glm::vec4(point, 1.0f));
    if (!(-seen.z > kNearest))
        return std::nullopt;
    const float half = view.orthographic_height > 0.0f
                           ? 0.5f * view.orthographic_height
                           : -seen.z * std::tan(0.5f * view.vertical_fov);
    return glm::vec2(0.5f + 0.5f * seen.x / (half * view.aspect), 0.5f - 0.5f * seen.y / half);
}

glm::vec2 ViewCamera::angles() const
{
    const glm::vec3 to = glm::normalize(forward());
    // Looking straight up or down, the image's up vector gives the azimuth.
    const glm::vec3 level = std::abs(to.y) < std::sin(kSteepest) ? to : -to.y * up();
    return {std::atan2(-level.x, -level.z), std::asin(std::clamp(to.y, -1.0f, 1.0f))};
}

void ViewCamera::stand_upright(const glm::vec2& angles)
{
    const float elevation = std::clamp(angles.y, -kSteepest, kSteepest);
    const glm::vec3 right(std::cos(angles.x), 0.0f, -std::sin(angles.x));
    const glm::vec3 to(-std::sin(angles.x) * std::cos(elevation), std::sin(elevation),
                       -std::cos(angles.x) * std::cos(elevation));
    view_.transform = {glm::vec4(right, 0.0f), glm::vec4(glm::cross(right, to), 0.0f),
                       glm::vec4(-to, 0.0f), view_.transform[3]};
}

void ViewCamera::look_at(const glm::vec3& target)
{
    const glm::vec3 way = target - eye();
    if (!(glm::length(way) > 0.0f))
        throw Error(ErrorKind::input, "", "the eye is at the point to look at");
    const glm::vec3 to = glm::normalize(way);
    const float azimuth = to.x != 0.0f || to.z != 0.0f ? std::atan2(-to.x, -to.z) : angles().x;
    stand_upright({azimuth, std::asin(std::clamp(to.y, -1.0f, 1.0f))});
}

void ViewCamera::walk(const glm::vec3& steps)
{
    const float azimuth = angles().x;
    const glm::vec3 ahead(-std::sin(azimuth), 0.0f, -std::cos(azimuth));
    const glm::vec3 right(std::cos(azimuth), 0.0f, -std::sin(azimuth));
    set_eye(eye() + steps.x * ahead + steps.y * right + glm::vec3(0.0f, steps.z, 0.0f));
}

void ViewCamera::gaze(float left, float up)
{
    stand_upright(angles() + glm::vec2(left, up));
}

void ViewCamera::orbit(const glm::vec3& pivot, float around, float over)
{
    const glm::vec3 seen = glm::transpose(glm::mat3(view_.transform)) * (pivot - eye());
    const glm::vec2 before = angles();
    stand_upright(before);
    stand_upright(before + glm::vec2(around, -over));
    set_eye(pivot - glm::mat3(view_.transform) * seen);
}

}  // namespace lumel
