#pragma once
// Light probes as white balls lit by their light.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "base/core/image.h"
#include "rays/cast/ray_scene.h"
#include "results/measure/light_probe.h"
#include "scene/values/view.h"

namespace lumel {

struct ProbeBall {
    glm::vec3 place;  ///< [m]
    ProbeLight light;
};

/// Maximum number of balls in an image.
inline constexpr std::size_t kMaxBalls = 2000;

/// Positions of probes as in lumel probes: a grid, and nodes named in the file. Throws Error{input}
/// for more than kMaxBalls.
std::vector<glm::vec3> ball_places(const Scene& scene, const RayScene& rays, double spacing);

/// Skips positions inside objects.
std::vector<ProbeBall> find_balls(const LightProbe& probe, std::span<const glm::vec3> places);

/// Paints the pixels in which a ball is the closest hit. paint: receives the pixel and H there
/// [lx]; called from many threads.
void draw_balls(Image& picture, const View& view, const RayScene& rays,
                std::span<const ProbeBall> balls, float radius,
                const std::function<void(float* pixel, const glm::vec3& irradiance)>& paint);

}  // namespace lumel
