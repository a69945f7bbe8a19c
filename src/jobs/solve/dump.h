#pragma once
// Intermediate images, for debugging.

#include <span>

#include "jobs/solve/setting.h"
#include "results/files/folder.h"

namespace lumel {

/// Writes each as NAME.exr with numbers and NAME.png for display, and commits the folder:
/// - hemicube (or hemisphere, by options.projection): distance from the lumel with the most power
///   to possible occluders [m], along each face's axis; 0: none. Outer walls of the scene occlude
///   nothing, and are left out. In the PNG nearer is brighter.
/// - illumination-1, -2, …: exitance [lm/m²] of the first, second, … surface under the zenith, as
///   in an illumination map of that direction. Alpha 0: none.
/// - near: row sums of the near field, the fraction of all light at a lumel that comes from close
///   pairs if everything is equally bright, as a map. Omitted without a near field.
/// - power: B A of each lumel [lm], as a map.
/// irradiance: [N] of the solution [lx]. setting: with its world. Waits for the device. Throws
/// Error{output}.
void write_dump(OutputFolder& folder, const gpu::Device& device, const Setting& setting,
                std::span<const glm::vec3> irradiance, const SolverOptions& options);

}  // namespace lumel
