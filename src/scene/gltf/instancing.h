#pragma once
// EXT_mesh_gpu_instancing: a node that shows its mesh many times.

#include "scene/gltf/document.h"

namespace lumel {

/// Gives every instance a node of its own, a child of the node that has the instances, at the end
/// of the list of nodes; takes the extension out of the document. Accessors are sound. Attributes
/// beside the places are dropped. Throws Error{input}.
void expand_instances(GltfDocument& document);

}  // namespace lumel
