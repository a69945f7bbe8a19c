#pragma once
// Reports of rendered images.

#include "jobs/bake/outputs.h"
#include "jobs/render/render.h"

namespace lumel {

/// Report of an image of a solved scene. options.height: as rendered.
Report picture_report(const RenderOptions& options, const SolveScene& prepared,
                      const gpu::Device& device, const Solver& solver, const Results& results,
                      const Stages& stages);

/// Report of a path-traced image. options.height: as rendered.
Report path_traced_report(const RenderOptions& options, const Scene& scene, const Stages& stages);

}  // namespace lumel
