#include "results/preview/view.h"

#include <algorithm>
#include <cmath>

namespace lumel {
namespace {

constexpr float kRoomFov = 1.15f;                   ///< [rad] horizontal, as for interiors
constexpr int kProbeColumns = 16, kProbeRows = 10;  ///< rays that score a candidate view

glm::mat4 look_at(const glm::vec3& eye, const glm::vec3& target)
{
    const glm::vec3 back = glm::normalize(eye - target);
    const glm::vec3 up = std::abs(back.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    return {glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0), glm::vec4(back, 0),
            glm::vec4(eye, 1)};
}

/// Scores a view: deep views of front faces count, empty space counts nothing, backs are negative.
float judge(const View& view, const RayScene& rays, float diagonal)
{
    const float tan_half = std::tan(0.5f * view.vertical_fov);
    float score = 0.0f;
    for (int row = 0; row < kProbeRows; ++row)
        for (int column = 0; column < kProbeColumns; ++column) {
            const float x =
                (2.0f * (float(column) + 0.5f) / kProbeColumns - 1.0f) * tan_half * view.aspect;
            const float y = (2.0f * (float(row) + 0.5f) / kProbeRows - 1.0f) * tan_half;
            const glm::vec3 direction =
                glm::normalize(glm::vec3(view.transform * glm::vec4(x, y, -1.0f, 0.0f)));
            RayHit hit;
            if (!rays.closest(glm::vec3(view.transform[3]), direction, 0.0f, 1e30f, 1, hit))
                continue;
            score += hit.front ? std::sqrt(std::min(hit.distance / diagonal, 0.7f)) : -1.0f;
        }
    return score;
}

/// Cameras in the corners and along the walls at eye height, facing across.
std::vector<View> inside_views(const glm::vec3& low, const glm::vec3& high)
{
    std::vector<View> views;
    const glm::vec3 centre = 0.5f * (low + high), extent = high - low;
    // From the walls inwards: a building's centre can be a courtyard.
    for (const float height : {0.55f, 0.35f, 0.2f})
        for (const float reach : {0.44f, 0.3f, 0.15f})
            for (int i = 0; i < 8; ++i) {
                const float angle = float(i) * 0.785398f + 0.3f;
                const glm::vec3 out(extent.x * std::cos(angle), 0.0f, extent.z * std::sin(angle));
                glm::vec3 eye = centre + reach * out;
                eye.y = low.y + height * extent.y;
                glm::vec3 target = centre - 0.2f * out;
                target.y = low.y + 0.76f * height * extent.y;
                if (glm::length(eye - target) > 0.0f)
                    views.push_back({look_at(eye, target), kRoomFov, kFreeAspect});
            }
    return views;
}

/// Cameras around the bounding box.
std::vector<View> outside_views(const glm::vec3& low, const glm::vec3& high)
{
    std::vector<View> views;
    const glm::vec3 centre = 0.5f * (low + high);
    constexpr float fov = 0.7f;
    const float distance = 0.5f * glm::length(high - low) / std::sin(0.5f * fov);
    for (int i = 0; i < 8; ++i) {
        const float angle = float(i) * 0.785398f + 0.5f;
        const glm::vec3 out = glm::normalize(glm::vec3(std::cos(angle), 0.45f, std::sin(angle)));
        views.push_back({look_at(centre + distance * out, centre), fov, kFreeAspect});
    }
    return views;
}

}  // namespace

View choose_view(const Scene& scene, const RayScene& rays)
{
    if (!scene.cameras.empty())
        return view_of(scene.cameras.front());
    const float diagonal = std::max(glm::length(rays.high() - rays.low()), 1e-6f);
    const auto better = [&](const View& a, const View& b) {
        return judge(a, rays, diagonal) < judge(b, rays, diagonal);
    };
    const std::vector<View> inside = inside_views(rays.low(), rays.high());
    const std::vector<View> outside = outside_views(rays.low(), rays.high());
    const View& from_outside = *std::max_element(outside.begin(), outside.end(), better);
    if (inside.empty())
        return from_outside;
    // A building's dark outer walls fill a view from outside, so inside views are preferred.
    constexpr float kInsideWorth = 4.0f;
    const View& from_inside = *std::max_element(inside.begin(), inside.end(), better);
    return kInsideWorth * judge(from_inside, rays, diagonal) > judge(from_outside, rays, diagonal)
               ? from_inside
               : from_outside;
}

}  // namespace lumel
