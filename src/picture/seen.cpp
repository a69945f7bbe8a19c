#include "picture/seen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/parallel.h"

namespace lumel {
namespace {

/// Rows of pixels worth a task.
constexpr std::size_t kRowsPerTask = 4;

/// Place k of S within a pixel: each has a column and a row of its own.
glm::vec2 place(std::uint32_t k, std::uint32_t sets)
{
    // Steps of about the golden ratio that leave out no row.
    std::uint32_t step = std::max(std::uint32_t(std::lround(0.618 * sets)), 1u);
    while (std::gcd(step, sets) != 1)
        ++step;
    return (glm::vec2(float(k), float(k * step % sets)) + 0.5f) / float(sets);
}

EyePoint eye_point(const Ray& ray, const RayHit& hit, const Shading& shading)
{
    return {ray.origin + ray.direction * hit.distance,
            shading.normal,
            shading.geometric,
            -ray.direction,
            shading.reflectance.specular,
            shading.reflectance.shininess};
}

}  // namespace

Seen look(const View& view, int width, int height, std::uint32_t sets, const RayScene& rays,
          const Surfaces& surfaces, const Sky& sky)
{
    Seen seen{width, height, sets, {}, {}, {}, {}};
    const std::size_t pixels = std::size_t(width) * std::size_t(height);
    seen.points.resize(pixels * sets);
    std::vector<EyePoint> eye_points(pixels);
    for (std::uint32_t set = 0; set < sets; ++set) {
        seen.first.push_back(std::uint32_t(seen.glossy.size()));
        const glm::vec2 within = place(set, sets);
        parallel_for(std::size_t(height), kRowsPerTask, [&](std::size_t top, std::size_t bottom) {
            for (std::size_t i = top * std::size_t(width); i < bottom * std::size_t(width); ++i) {
                const std::size_t row = i / std::size_t(width);
                const glm::vec2 pixel(float(i % std::size_t(width)), float(row));
                const Ray ray =
                    ray_through(view, (pixel + within) / glm::vec2(float(width), float(height)));
                SeenPoint& point = seen.points[set * pixels + i];
                if (!rays.closest(ray.origin, ray.direction, 0.0f,
                                  std::numeric_limits<float>::max(),
                                  std::uint32_t(set * pixels + i), point.hit)) {
                    point.sky = !sky.empty();
                    point.luminance = sky_radiance(sky, ray.direction);
                    continue;
                }
                const Shading shading = surfaces.shade(point.hit);
                point.there = true;
                point.diffuse = shading.reflectance.diffuse;
                point.luminance = shading.luminance;
                eye_points[i] = eye_point(ray, point.hit, shading);
            }
        });
        for (std::size_t i = 0; i < pixels; ++i)
            if (seen.points[set * pixels + i].there && eye_points[i].specular != glm::vec3(0.0f)) {
                seen.glossy.push_back(eye_points[i]);
                seen.index.push_back(std::uint32_t(set * pixels + i));
            }
    }
    seen.first.push_back(std::uint32_t(seen.glossy.size()));
    return seen;
}

}  // namespace lumel
