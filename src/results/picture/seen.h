#pragma once
// Surface points seen through the pixels of an image.

#include <cstdint>
#include <functional>
#include <vector>

#include "methods/glossy/eye_image.h"
#include "rays/cast/ray_scene.h"
#include "rays/paths/surfaces.h"
#include "scene/values/view.h"

namespace lumel {

/// A point of a surface behind a pixel.
struct SeenPoint {
    RayHit hit;
    // Both after transmission by glass in front of the point:
    glm::vec3 diffuse{0.0f};    ///< ρ_d
    glm::vec3 luminance{0.0f};  ///< emitted [cd/m²]; the sky's without a surface
    bool there = false;         ///< a surface is seen
    bool sky = false;           ///< the sky is seen
};

/// S points behind each pixel, at the same positions in all pixels.
struct Seen {
    int width = 0;
    int height = 0;
    std::uint32_t sets = 0;            ///< S
    std::vector<SeenPoint> points;     ///< [S][height][width]
    std::vector<EyePoint> glossy;      ///< [G] glossy points, in the same order
    std::vector<std::uint32_t> index;  ///< [G] into points
    std::vector<std::uint32_t> first;  ///< [S + 1] start of each set in `glossy`
};

/// Traces a ray through S = `sets` ≥ 1 positions of every pixel. `progress` receives the fraction
/// done and returns false to stop; the result then has the complete sets, at least one.
Seen look(const View& view, int width, int height, std::uint32_t sets, const RayScene& rays,
          const Surfaces& surfaces, const Sky& sky,
          const std::function<bool(double)>& progress = {});

}  // namespace lumel
