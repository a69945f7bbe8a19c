#pragma once
// Pipelines of `lumel reference` and of `lumel render --paths`.

#include <cstdint>
#include <string>

#include "base/core/image.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "scene/values/view.h"
#include "truth/reference.h"

namespace lumel {

/// lumel reference: path traces the atlas of a bake on the CPU: lightmap.exr, lightmap.png,
/// report.json. materials: as used by the solver to compare with.
BakeSummary bake_reference(const std::string& scene_path, const std::string& folder,
                           const BakeOptions& options, const ReferenceOptions& reference,
                           MaterialModel materials, const ProgressFunction& progress = {});

/// Path traces an image of width × height pixels [cd/m²] with `paths` paths per pixel, as the stage
/// "path tracing". Throws Error{stopped} if stopped before each pixel has some.
Image path_traced_picture(const Scene& scene, const RayScene& rays, const View& view,
                          const glm::ivec2& size, int paths, std::uint32_t seed, Stages& stages);

}  // namespace lumel
