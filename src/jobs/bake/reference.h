#pragma once
// The truth: the score of `lumel reference` and of `lumel render --paths`.

#include <cstdint>
#include <string>

#include "base/core/image.h"
#include "jobs/solve/bake_options.h"
#include "jobs/solve/stages.h"
#include "scene/values/view.h"
#include "truth/reference.h"

namespace lumel {

/// lumel reference: the same atlas by path tracing on the CPU: lightmap.exr, lightmap.png,
/// report.json. `materials`: what is read of them, as the solver to compare with does.
BakeSummary bake_reference(const std::string& scene_path, const std::string& folder,
                           const BakeOptions& options, const ReferenceOptions& reference,
                           MaterialModel materials, const ProgressFunction& progress = {});

/// A picture of width × height pixels [cd/m²] by this number of paths for each, as the stage "path
/// tracing". Throws Error{stopped} if stopped before each has some.
Image path_traced_picture(const Scene& scene, const RayScene& rays, const View& view,
                          const glm::ivec2& size, int paths, std::uint32_t seed, Stages& stages);

}  // namespace lumel
