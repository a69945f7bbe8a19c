#pragma once
// lumel render --layers: an image of each lamp, which add up to that of all.

#include <string>

#include "jobs/render/render.h"
#include "jobs/solve/stages.h"
#include "results/record/report.h"
#include "scene/values/scene.h"

namespace lumel {

/// Throws Error{input} for options that exclude layers.
void check_layers(const RenderOptions& options);

/// Writes picture.png or .exr of all lamps and, for each lamp, picture-lamp-NAME.exr with its
/// radiance and picture-lamp-NAME.png, a layer for pages: see page_layer(). picture-black.png lies
/// below the layers, picture-white.png above them. Throws Error.
Report render_layers(Scene scene, const std::string& path, RenderOptions options, Stages& stages);

}  // namespace lumel
