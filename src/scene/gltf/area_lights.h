#pragma once
// EXT_lights_area: rectangles and disks that emit from one side.

#include "scene/gltf/document.h"

namespace lumel {

/// Replaces the area lights of nodes by meshes: appends a black, emissive, single-sided shape as a
/// child of each node, and removes the extension from the document. Lights of intensity 0 add
/// nothing. Requires valid accessors. Throws Error{input}.
void expand_area_lights(GltfDocument& document);

}  // namespace lumel
