#pragma once
// EXT_meshopt_compression and KHR_meshopt_compression: bufferViews whose bytes are coded.

#include "scene/gltf/document.h"

namespace lumel {

/// True for a buffer that only stands for what coded bufferViews decode to, and has no data.
bool is_fallback(const JsonView& buffer);

/// Decodes every coded bufferView into a buffer of its own, unless its buffer has the plain data,
/// and takes the extension out of the document. Buffers are loaded, bufferViews not checked yet.
/// Throws Error{input}.
void decode_meshopt(GltfDocument& document);

}  // namespace lumel
