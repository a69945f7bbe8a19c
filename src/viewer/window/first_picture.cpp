#include "viewer/window/first_picture.h"

#include <algorithm>

#include "base/core/parallel.h"
#include "base/images/tone_curve.shared.h"
#include "rays/paths/surfaces.h"

namespace lumel {
namespace {

constexpr glm::vec3 kNothing{0.1f};
constexpr float kEdge = 0.3f;  ///< brightness of surfaces seen edge-on
constexpr std::size_t kRows = 4;

glm::vec3 colour_along(const Ray& ray, const RayScene& rays, const Surfaces& surfaces)
{
    RayHit hit;
    if (!rays.closest(ray_out(ray.origin, ray.direction, 0), hit))
        return kNothing;
    const Shading shading = surfaces.shade(hit);
    if (shading.luminance != glm::vec3(0.0f))
        return glm::vec3(1.0f);
    const float facing = std::abs(glm::dot(shading.normal, ray.direction));
    return (kEdge + (1.0f - kEdge) * facing) * shading.reflectance.diffuse;
}

}  // namespace

Image first_picture(const Scene& scene, const RayScene& rays, const View& view,
                    const glm::ivec2& size)
{
    const Surfaces surfaces(scene);
    Image image(size.x, size.y, 3);
    parallel_for(std::size_t(size.y), kRows, [&](std::size_t first, std::size_t last) {
        for (int y = int(first); y < int(last); ++y)
            for (int x = 0; x < size.x; ++x) {
                const glm::vec2 place = (glm::vec2(x, y) + 0.5f) / glm::vec2(size);
                const glm::vec3 colour = colour_along(ray_through(view, place), rays, surfaces);
                const glm::vec3 codes = srgb_from_linear(glm::clamp(colour, 0.0f, 1.0f));
                std::copy_n(&codes[0], 3, image.at(x, y));
            }
    });
    return image;
}

}  // namespace lumel
