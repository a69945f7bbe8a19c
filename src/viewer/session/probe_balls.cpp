#include "viewer/session/probe_balls.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "base/core/error.h"
#include "base/core/parallel.h"
#include "results/measure/probe_grid.h"
#include "scene/load/probe_places.h"
#include "viewer/session/camera.h"

namespace lumel {
namespace {

constexpr std::size_t kBallRows = 4, kProbes = 1;  ///< minimum per task

/// Bounding box of a ball in the image, from low to high [pixels].
struct Drawn {
    const ProbeBall* ball;
    glm::ivec2 low, high;
};

/// From the corners of its box; empty if it is too close to the eye.
std::optional<Drawn> drawn(const ProbeBall& ball, float radius, const View& view,
                           const glm::vec2& size)
{
    glm::vec2 low(1.0f), high(0.0f);
    constexpr int kCorners = 8;
    for (int corner = 0; corner < kCorners; ++corner) {
        const glm::vec3 side(corner & 1 ? 1.0f : -1.0f, corner & 2 ? 1.0f : -1.0f,
                             corner & 4 ? 1.0f : -1.0f);
        const std::optional<glm::vec2> at = place_in_picture(view, ball.place + radius * side);
        if (!at)
            return std::nullopt;
        low = glm::min(low, *at);
        high = glm::max(high, *at);
    }
    return Drawn{&ball, glm::ivec2(glm::max(glm::floor(low * size), 0.0f)),
                 glm::ivec2(glm::min(glm::ceil(high * size), size))};
}

/// Distance at which a ray enters a ball [m]; < 0 if it does not.
float entry(const Ray& ray, const glm::vec3& centre, float radius)
{
    const glm::vec3 to = centre - ray.origin;
    const float along = glm::dot(to, ray.direction);
    const float inside = along * along - glm::dot(to, to) + radius * radius;
    return inside > 0.0f ? along - std::sqrt(inside) : -1.0f;
}

}  // namespace

std::vector<glm::vec3> ball_places(const Scene& scene, const RayScene& rays, double spacing)
{
    std::vector<glm::vec3> places;
    const ProbeGrid grid = probe_grid(rays.low(), rays.high(), spacing);
    const double count = double(grid.counts.x) * double(grid.counts.y) * double(grid.counts.z);
    if (count > double(kMaxBalls))
        throw Error(ErrorKind::input, "",
                    fmt::format("{:.0f} probes are more than the limit of {}; use a wider spacing",
                                count, kMaxBalls));
    for (const glm::dvec3& point : grid.points())
        places.emplace_back(point);
    for (const ProbePlace& place : probe_places(scene.path))
        places.emplace_back(place.position - scene.origin);
    return places;
}

std::vector<ProbeBall> find_balls(const LightProbe& probe, std::span<const glm::vec3> places)
{
    std::vector<ProbeBall> balls(places.size());
    parallel_for(places.size(), kProbes, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            balls[i] = {places[i], probe.read(places[i], std::uint32_t(i))};
    });
    std::erase_if(balls, [](const ProbeBall& ball) { return ball.light.inside; });
    return balls;
}

void draw_balls(Image& picture, const View& view, const RayScene& rays,
                std::span<const ProbeBall> balls, float radius,
                const std::function<void(float* pixel, const glm::vec3& irradiance)>& paint)
{
    const glm::vec2 size(picture.width, picture.height);
    std::vector<Drawn> all;
    for (const ProbeBall& ball : balls)
        if (const std::optional<Drawn> one = drawn(ball, radius, view, size))
            all.push_back(*one);
    parallel_for(std::size_t(picture.height), kBallRows, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < picture.width; ++x) {
                const Ray ray = ray_through(view, (glm::vec2(x, y) + 0.5f) / size);
                const Drawn* nearest = nullptr;
                float distance = 0.0f;
                for (const Drawn& one : all) {
                    if (x < one.low.x || x >= one.high.x || y < one.low.y || y >= one.high.y)
                        continue;
                    const float at = entry(ray, one.ball->place, radius);
                    if (at > 0.0f && (!nearest || at < distance)) {
                        nearest = &one;
                        distance = at;
                    }
                }
                RayHit hit;
                if (!nearest || (rays.closest(ray_out(ray.origin, ray.direction, 0), hit) &&
                                 hit.distance < distance))
                    continue;
                const glm::vec3 normal =
                    (ray.origin + distance * ray.direction - nearest->ball->place) / radius;
                paint(picture.at(x, y),
                      glm::max(irradiance_at(nearest->ball->light.coefficients, normal), 0.0f));
            }
    });
}

}  // namespace lumel
