#pragma once
// EXT_meshopt_compression and KHR_meshopt_compression: encoded bufferViews.

#include <cstddef>
#include <cstdint>
#include <span>

#include "scene/gltf/document.h"

namespace lumel {

/// True for a placeholder buffer without data, for decoded bufferViews.
bool is_fallback(const JsonView& buffer);

/// Decodes every encoded bufferView whose buffer has no plain data into a new buffer, and removes
/// the extension from the document. Requires loaded buffers; bufferViews are unchecked. Throws
/// Error{input}.
void decode_meshopt(GltfDocument& document);

/// A bufferView for the encoder.
struct PlainView {
    std::span<const std::uint8_t> bytes;
    std::size_t stride = 0;  ///< of an element; bytes has a whole number of them
    bool is_indices = false;
};

/// True if the extension can hold such elements.
bool is_encodable(const PlainView& view);

/// A bufferView encoded without filters, so that it decodes to the same bytes: what the member
/// "extensions" of the bufferView needs, without buffer and byteOffset, and its data. Requires
/// is_encodable().
struct EncodedView {
    Json extension;
    Bytes bytes;
};
EncodedView encode_meshopt(const PlainView& view);

/// The extension's name.
inline constexpr const char* kMeshoptExtension = "EXT_meshopt_compression";

}  // namespace lumel
