#pragma once
// Accessors: where their elements lie, proven to be inside their buffers.

#include "scene/gltf/document.h"

namespace lumel {

/// Throws Error{input} if an accessor of the file is malformed or reaches outside its data.
void check_accessors(const GltfDocument& document);

/// The bytes of the bufferView that `index` refers to.
Bytes buffer_view_bytes(const GltfDocument& document, const JsonView& index);

/// Component values as floats, normalised integers mapped to 0…1 or -1…1: [count * components].
std::vector<float> to_floats(const AccessorData& data);

/// Unsigned components widened to 32 bits: [count * components].
std::vector<std::uint32_t> to_unsigned(const AccessorData& data);

}  // namespace lumel
