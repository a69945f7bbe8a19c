#pragma once
// Point and spot lights, through hemicubes.

#include <cstdint>
#include <functional>

#include "scene/scene.h"
#include "visibility/eye_views.h"

namespace lumel {

struct LampOptions {
    Projection projection = Projection::hemicube;
    std::uint32_t hemicube = 256;  ///< side of the front face [pixels], see EyeViews
    std::uint32_t batch = 16;      ///< eyes at a time
    std::uint32_t points = 16;     ///< looked from per lamp that is a point
    std::uint32_t ball_points = 128;  ///< per lamp that is a ball
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds to irradiance [N] [lx] what the scene's point and spot lights send straight to the lumels.
/// `go_on` is given the fraction done and returns false to stop. Returns false if it was stopped.
bool add_lamps(gpu::Pacer& pacer, const gpu::Device& device, const World& world,
               const Scene& scene, const LampOptions& options,
               const gpu::Array<glm::vec3>& irradiance, const std::function<bool(double)>& go_on);

}  // namespace lumel
