#pragma once
// What an eye sees through the pixels of a picture.

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
    // Of both, what passes the glass before the point:
    glm::vec3 diffuse{0.0f};    ///< ρ_d
    glm::vec3 luminance{0.0f};  ///< emitted [cd/m²]; of the sky where no surface is
    bool there = false;         ///< false: no surface is seen
    bool sky = false;           ///< the sky is seen
};

/// S points behind each pixel, at the same places within all of them.
struct Seen {
    int width = 0;
    int height = 0;
    std::uint32_t sets = 0;            ///< S
    std::vector<SeenPoint> points;     ///< [S][height][width]
    std::vector<EyePoint> glossy;      ///< [G] those with gloss, in the same order
    std::vector<std::uint32_t> index;  ///< [G] into points
    std::vector<std::uint32_t> first;  ///< [S + 1] where each set begins among the glossy
};

/// Follows a ray through S = `sets` places of every pixel, 1 or more. `progress` receives the
/// fraction done and returns false to stop, which leaves the sets that are whole, one at least.
Seen look(const View& view, int width, int height, std::uint32_t sets, const RayScene& rays,
          const Surfaces& surfaces, const Sky& sky,
          const std::function<bool(double)>& progress = {});

}  // namespace lumel
