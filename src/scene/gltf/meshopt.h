#pragma once
// EXT_meshopt_compression and KHR_meshopt_compression: encoded bufferViews.

#include "scene/gltf/document.h"

namespace lumel {

/// True for a placeholder buffer without data, for decoded bufferViews.
bool is_fallback(const JsonView& buffer);

/// Decodes every encoded bufferView whose buffer has no plain data into a new buffer, and removes
/// the extension from the document. Requires loaded buffers; bufferViews are unchecked. Throws
/// Error{input}.
void decode_meshopt(GltfDocument& document);

}  // namespace lumel
