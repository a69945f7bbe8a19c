#pragma once
// Punctual lights and cameras of a glTF file.

#include "scene/gltf/document.h"
#include "scene/load/gltf_nodes.h"
#include "scene/values/scene.h"

namespace lumel {

/// Reads the lights of KHR_lights_punctual and the cameras of the placed nodes into scene.lights
/// and scene.cameras. Throws Error{input}.
void read_lights_and_cameras(const GltfDocument& document, const std::vector<PlacedNode>& nodes,
                             Scene& scene);

}  // namespace lumel
