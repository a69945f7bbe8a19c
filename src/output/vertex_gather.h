#pragma once
// Vertex arrays in a new order, in the number format they came in.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>

#include <glm/glm.hpp>

#include "output/glb_builder.h"

namespace lumel {

/// Adds accessors to a builder; each returns the new accessor's index.
class VertexGather {
public:
    explicit VertexGather(GlbBuilder& builder) : builder_(builder) {}

    /// Element i of the new accessor is element vertices[i] of `accessor` (a JSON index), byte
    /// for byte. `semantic` POSITION also gets min and max. Throws Error{input}.
    std::size_t gather(const Json& accessor, std::span<const std::uint32_t> vertices,
                       const std::string& semantic);
    std::size_t add_texcoords(std::span<const glm::vec2> texcoords);
    /// 16 bits where `vertex_count` allows it, else 32.
    std::size_t add_indices(std::span<const std::uint32_t> indices, std::size_t vertex_count);

private:
    const AccessorData& data_of(std::size_t accessor);

    GlbBuilder& builder_;
    std::map<std::size_t, AccessorData> read_;
};

}  // namespace lumel
