#pragma once
// `lumel bake` and `lumel info`.

#include <string>

#include "jobs/solve/bake_options.h"

namespace lumel {

class Ranks;

/// lumel bake: reads `scene_path`, solves, and writes lightmap.exr, lightmap.png, scene.glb,
/// scene-baked.glb, preview.png and report.json into `folder`. ranks: that share the work, of which
/// the first writes the files and returns the summary; null: none. Throws Error.
BakeSummary bake(const std::string& scene_path, const std::string& folder,
                 const BakeOptions& options, const ProgressFunction& progress = {},
                 Ranks* ranks = nullptr);

/// Throws Error{input} if the options ask for results that need all light, but for a part of it.
void check_parts(const BakeOptions& options);

/// lumel info: contents of the scene and cost of a bake, as text or JSON.
std::string describe(const std::string& scene_path, const BakeOptions& options, bool json);

}  // namespace lumel
