#pragma once
// The binary glTF container (.glb): a header and chunks.

#include <optional>
#include <string>

#include "scene/gltf/files.h"

namespace lumel {

/// Byte ranges of the parts of a .glb.
struct GlbChunks {
    std::size_t json_offset = 0;
    std::size_t json_size = 0;
    std::optional<std::size_t> binary_offset;  ///< nullopt without a BIN chunk
    std::size_t binary_size = 0;
};

/// True if the bytes begin as a .glb.
bool is_glb(const Bytes& bytes);

/// Throws Error{input} if header and chunks are inconsistent or the file is truncated.
GlbChunks split_glb(const std::string& path, const Bytes& bytes);

}  // namespace lumel
