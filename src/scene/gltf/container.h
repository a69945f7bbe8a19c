#pragma once
// The binary glTF container (.glb): a header and chunks.

#include <optional>
#include <string>

#include "scene/gltf/files.h"

namespace lumel {

/// Where the parts of a .glb stand in its bytes.
struct GlbChunks {
    std::size_t json_offset = 0;
    std::size_t json_size = 0;
    std::optional<std::size_t> binary_offset;  ///< absent without a BIN chunk
    std::size_t binary_size = 0;
};

/// True if the bytes start like a .glb.
bool is_glb(const Bytes& bytes);

/// Throws Error{input} if header or chunks contradict each other or the file is cut short.
GlbChunks split_glb(const std::string& path, const Bytes& bytes);

}  // namespace lumel
