#pragma once
// Images of lumel measure: illuminance in false colours, with a legend in lux.

#include <span>

#include "atlas/prepare/solve_scene.h"
#include "base/core/image.h"
#include "gpu/device.h"
#include "results/measure/work_plane.h"

namespace lumel {

/// A plane from above, +x to the right and +z down. Points inside objects are grey. readings
/// [rows][columns] of the grid.
Image plane_picture(const PlaneGrid& grid, std::span<const Reading> readings);

/// The view of preview.png, `width` pixels wide without the legend; pixels without surfaces are
/// grey. irradiance [N] [lx].
Image preview_picture(const gpu::Device& device, const SolveScene& prepared,
                      std::span<const glm::vec3> irradiance, int width);

}  // namespace lumel
