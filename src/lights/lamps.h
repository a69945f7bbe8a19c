#pragma once
// Point and spot lights, through hemicubes.

#include <cstdint>
#include <functional>

#include "lights/light_sums.h"
#include "scene/scene.h"
#include "visibility/eye_views.h"

namespace lumel {

struct LampOptions {
    std::uint32_t hemicube = 512;     ///< side of the front face [pixels], see EyeViews
    std::uint32_t points = 16;        ///< looked from per lamp that is a point
    std::uint32_t ball_points = 128;  ///< per lamp that is a ball
    std::uint32_t seed = 1;
    bool centre = false;  ///< receive at lumels' centroids
};

/// Adds the direct light of the scene's point and spot lights at the lumels to `light`, each lamp
/// as one source. Hemicubes, whose edges are exact, are used whatever projection solvers use.
/// `go_on` receives the fraction done and returns false to stop. Returns false if it was stopped.
bool add_lamps(const gpu::Device& device, const World& world, const Scene& scene,
               const LampOptions& options, SummedLight& light,
               const std::function<bool(double)>& go_on);

/// Pixels of the views of one batch.
std::uint64_t lamp_pixels(const LampOptions& options);

}  // namespace lumel
