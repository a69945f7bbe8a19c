#pragma once
// Accessors: locations of their elements, verified to be inside their buffers.

#include "scene/gltf/document.h"

namespace lumel {

/// Throws Error{input} if an accessor of the file is malformed or exceeds its data.
void check_accessors(const GltfDocument& document);

/// Bytes of the bufferView at the index in `index`.
Bytes buffer_view_bytes(const GltfDocument& document, const JsonView& index);

/// Component values as floats [count * components]; normalised integers are mapped to 0…1 or -1…1.
std::vector<float> to_floats(const AccessorData& data);

/// Unsigned components as 32 bits [count * components].
std::vector<std::uint32_t> to_unsigned(const AccessorData& data);

}  // namespace lumel
