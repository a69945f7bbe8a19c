#pragma once
// The pictures of lumel measure: illuminance in false colours, with a legend in lux.

#include <span>

#include "atlas/prepare/prepare.h"
#include "base/core/image.h"
#include "gpu/device.h"
#include "results/measure/work_plane.h"

namespace lumel {

/// A plane from above, +x to the right and +z down. Points inside of things are grey.
/// readings [rows][columns] of the grid.
Image plane_picture(const PlaneGrid& grid, std::span<const Reading> readings);

/// The view of preview.png, `width` pixels wide beside the legend; what is no surface is grey.
/// irradiance [N] [lx].
Image preview_picture(const gpu::Device& device, const Prepared& prepared,
                      std::span<const glm::vec3> irradiance, int width);

}  // namespace lumel
