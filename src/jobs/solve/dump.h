#pragma once
// Intermediate images, for people who look inside.

#include <span>

#include "atlas/near/near_field.h"
#include "atlas/prepare/prepare.h"
#include "methods/options.h"
#include "raster/world/world.h"
#include "results/files/folder.h"

namespace lumel {

/// A scene that was solved, on the host and on the device.
struct Solved {
    const Prepared& prepared;
    const World& world;
    const NearField& near;
    std::span<const glm::vec3> irradiance;  ///< [N] [lx]
};

/// Writes each as NAME.exr with numbers and NAME.png to look at, and commits the folder:
/// - hemicube (or hemisphere, as options.projection says): the distance from the lumel of the
///   largest power to what may hide others from it [m], along each face's axis; 0: nothing does.
///   Outer walls of the scene hide nothing, and are left out. In the PNG nearer is brighter.
/// - illumination-1, -2, …: exitance [lm/m²] of what lies first, second, … under the zenith, as an
///   illumination map of that direction shows it. Alpha 0: nothing.
/// - near: row sums of the near field, the part of all light at a lumel that close pairs send if
///   all is equally bright, as a map. Not written if there is no near field.
/// - power: B A of each lumel [lm], as a map.
/// Waits for the device. Throws Error{output}.
void write_dump(OutputFolder& folder, const gpu::Device& device, const Solved& solved,
                const SolverOptions& options);

}  // namespace lumel
