#pragma once
// Light probes as balls in the air: what arrives where they are, on white.

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

/// Balls that pictures show at most.
inline constexpr std::size_t kMaxBalls = 2000;

/// Where lumel probes has probes: over a grid, and at nodes that the file names. Throws
/// Error{input} for more than kMaxBalls.
std::vector<glm::vec3> ball_places(const Scene& scene, const RayScene& rays, double spacing);

/// None of what lies inside of something.
std::vector<ProbeBall> find_balls(const LightProbe& probe, std::span<const glm::vec3> places);

/// Paints pixels of a picture in which a ball is nearer than all that the rays meet. paint: gets
/// the pixel and H of its place [lx]; from many threads.
void draw_balls(Image& picture, const View& view, const RayScene& rays,
                std::span<const ProbeBall> balls, float radius,
                const std::function<void(float* pixel, const glm::vec3& irradiance)>& paint);

}  // namespace lumel
