#pragma once
// Reports of rendered images.

#include "jobs/bake/outputs.h"
#include "jobs/render/render.h"

namespace lumel {

/// The facts of a picture of a solved scene. options.height: as the picture is.
Report picture_report(const RenderOptions& options, const Prepared& prepared,
                      const gpu::Device& device, const Solver& solver, const Results& results,
                      const Stages& stages);

/// The facts of a path-traced picture. options.height: as the picture is.
Report path_traced_report(const RenderOptions& options, const Scene& scene, const Stages& stages);

}  // namespace lumel
