#pragma once
// KHR_draco_mesh_compression: primitives with encoded vertices and triangles.

#include "scene/gltf/document.h"

namespace lumel {

/// Decodes every encoded primitive whose accessors have no plain data into new buffers, and removes
/// the extension from the document. Requires valid bufferViews; accessors are unchecked. Throws
/// Error{input}.
void decode_draco(GltfDocument& document);

/// The extension's name.
inline constexpr const char* kDracoExtension = "KHR_draco_mesh_compression";

}  // namespace lumel
