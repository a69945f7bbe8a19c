#pragma once
// Primitives of a glTF as Draco streams.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/gltf/document.h"
#include "scene/pack/draco_encode.h"

namespace lumel {

struct PackedPrimitive {
    struct Attribute {
        std::string name;
        std::uint32_t id = 0;  ///< in the stream
        Json accessor;         ///< of the plain file
    };
    std::size_t mesh = 0, primitive = 0;  ///< indices in the document
    std::vector<Attribute> attributes;
    EncodedDraco encoded;
};

/// Encodes all triangle lists that become smaller. Morphed primitives stay plain, and parts of one
/// that is split over pages, because parts share vertices. Throws Error{input}.
std::vector<PackedPrimitive> pack_primitives(const GltfDocument& document);

}  // namespace lumel
