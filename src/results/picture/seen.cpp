#include "results/picture/seen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/core/parallel.h"

namespace lumel {
namespace {

constexpr std::size_t kRowsPerTask = 4;
/// Rows between progress reports.
constexpr std::size_t kRowsPerStep = 64;

/// Position k of S within a pixel: each has a different column and row.
glm::vec2 place(std::uint32_t k, std::uint32_t sets)
{
    // Steps near the golden ratio that leave out no row.
    std::uint32_t step = std::max(std::uint32_t(std::lround(0.618 * sets)), 1u);
    while (std::gcd(step, sets) != 1)
        ++step;
    return (glm::vec2(float(k), float(k * step % sets)) + 0.5f) / float(sets);
}

/// The surface point behind a position of a pixel. `eye` is unchanged if there is none.
SeenPoint see(const Ray& ray, std::uint32_t seed, const RayScene& rays, const Surfaces& surfaces,
              const Sky& sky, EyePoint& eye)
{
    SeenPoint point;
    point.there = rays.closest(ray.origin, ray.direction, 0.0f, std::numeric_limits<float>::max(),
                               seed, point.hit);
    if (!point.there) {
        point.sky = !sky.empty();
        point.luminance = point.hit.tint * sky_radiance(sky, ray.direction);
        return point;
    }
    const Shading shading = surfaces.shade(point.hit);
    point.diffuse = point.hit.tint * shading.reflectance.diffuse;
    point.luminance = point.hit.tint * shading.luminance;
    eye = {ray.origin + ray.direction * point.hit.distance,
           shading.normal,
           shading.geometric,
           -ray.direction,
           point.hit.tint * shading.reflectance.specular,
           shading.reflectance.shininess};
    return point;
}

}  // namespace

Seen look(const View& view, int width, int height, std::uint32_t sets, const RayScene& rays,
          const Surfaces& surfaces, const Sky& sky, const std::function<bool(double)>& progress)
{
    Seen seen{width, height, 0, {}, {}, {}, {0}};
    const auto columns = std::size_t(width), rows = std::size_t(height), pixels = columns * rows;
    const glm::vec2 size{float(width), float(height)};
    seen.points.resize(pixels * sets);
    std::vector<EyePoint> eye_points(pixels);
    for (; seen.sets < sets; ++seen.sets) {
        const std::size_t start = seen.sets * pixels;
        const auto look_at_rows = [&](std::size_t top, std::size_t bottom) {
            const glm::vec2 within = place(seen.sets, sets);
            for (std::size_t i = top * columns; i < bottom * columns; ++i) {
                const std::size_t row = i / columns;
                const glm::vec2 pixel(float(i % columns), float(row));
                const Ray ray = ray_through(view, (pixel + within) / size);
                seen.points[start + i] =
                    see(ray, std::uint32_t(start + i), rays, surfaces, sky, eye_points[i]);
            }
        };
        const auto go_on = [&](std::size_t done) {
            const double share = double(done) / double(rows);
            return !progress || progress((seen.sets + share) / sets) || seen.sets == 0;
        };
        if (!parallel_steps(rows, kRowsPerStep, kRowsPerTask, look_at_rows, go_on))
            break;
        for (std::size_t i = 0; i < pixels; ++i)
            if (seen.points[start + i].there && eye_points[i].specular != glm::vec3(0.0f)) {
                seen.glossy.push_back(eye_points[i]);
                seen.index.push_back(std::uint32_t(start + i));
            }
        seen.first.push_back(std::uint32_t(seen.glossy.size()));
    }
    seen.points.resize(pixels * seen.sets);
    return seen;
}

}  // namespace lumel
