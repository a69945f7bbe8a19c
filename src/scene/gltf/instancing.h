#pragma once
// EXT_mesh_gpu_instancing: nodes that instance their mesh.

#include "scene/gltf/document.h"

namespace lumel {

/// Appends a node for every instance, as a child of the instancing node, and removes the extension
/// from the document. Drops attributes other than transforms. Requires valid accessors. Throws
/// Error{input}.
void expand_instances(GltfDocument& document);

}  // namespace lumel
