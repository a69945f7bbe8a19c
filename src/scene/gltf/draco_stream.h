#pragma once
// One stream of Draco: a mesh as triangles and attributes.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "scene/gltf/document.h"

namespace lumel {

struct DracoAttribute {
    std::uint32_t id = 0;               ///< what a file calls it by
    std::optional<ComponentType> type;  ///< none: one that glTF does not have
    std::size_t components = 0;
    Bytes bytes;  ///< [points][components]
};

struct DracoMesh {
    std::size_t points = 0;
    std::vector<std::uint32_t> indices;  ///< [3 * triangles]
    std::vector<DracoAttribute> attributes;
};

/// What streams of `bytes` bytes may decode to, all together [faces]. Equal symbols take no bytes
/// at all, so that the bytes alone are no bound: the bound is generous, and small files have it
/// too.
std::size_t draco_allowance(std::size_t bytes);

/// Decodes a stream and takes what it needed off the allowance. `place` names the stream. Throws
/// Error{input} if it is broken, older than bitstream 2.2, or needs more than is left; memory is
/// taken only for what is allowed.
DracoMesh decode_draco_stream(const JsonView& place, std::span<const std::uint8_t> stream,
                              std::size_t& allowance);

}  // namespace lumel
