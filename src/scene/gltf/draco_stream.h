#pragma once
// A Draco stream: one mesh as triangles and attributes.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/gltf/document.h"

namespace lumel {

struct DracoAttribute {
    std::uint32_t id = 0;               ///< identifier in the file
    std::optional<ComponentType> type;  ///< nullopt if glTF does not have it
    std::size_t components = 0;
    Bytes bytes;  ///< [points][components]
};

struct DracoMesh {
    std::size_t points = 0;
    std::vector<std::uint32_t> indices;  ///< [3 * triangles]
    std::vector<DracoAttribute> attributes;
};

/// Total limit of faces for streams of `bytes` bytes. Equal symbols take no bytes, so the size
/// alone gives no bound; the limit is generous, for small files too.
std::size_t draco_allowance(std::size_t bytes);

/// Decodes a stream and subtracts its faces from the allowance. `place` names the stream. Throws
/// Error{input} if it is broken, older than bitstream 2.2, or exceeds the allowance. Allocates
/// memory only within it.
DracoMesh decode_draco_stream(const JsonView& place, std::span<const std::uint8_t> stream,
                              std::size_t& allowance);

}  // namespace lumel
