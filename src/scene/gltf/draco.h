#pragma once
// KHR_draco_mesh_compression: primitives whose vertices and triangles are coded.

#include "scene/gltf/document.h"

namespace lumel {

/// Decodes every coded primitive, unless its accessors have plain data, into accessors over buffers
/// of their own, and takes the extension out of the document. BufferViews are sound, accessors not
/// checked yet. Throws Error{input}.
void decode_draco(GltfDocument& document);

}  // namespace lumel
