#pragma once
// Reorders vertex arrays in their original number format.

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "results/files/glb_builder.h"

namespace lumel {

/// Vertices from this number on need indices of 32 bits: 65535 itself means restart.
inline constexpr std::size_t kShortIndexLimit = 65535;

/// Sets min and max of an accessor: of the numbers in `bytes`, stored every `stride` bytes, not
/// normalised.
void add_bounds(Json& accessor, ComponentType type, std::size_t components,
                std::span<const std::uint8_t> bytes, std::size_t stride);

/// Adds accessors to a builder; each call returns an accessor's index. Equal arrays, such
/// as those of a mesh under several nodes, are added once.
class VertexGather {
public:
    explicit VertexGather(GlbBuilder& builder) : builder_(builder) {}

    /// Element i of the new accessor is element vertices[i] of `accessor` (a JSON index), byte for
    /// byte. semantic: POSITION also gets min and max. Throws Error{input}.
    std::size_t gather(const Json& accessor, const std::vector<std::uint32_t>& vertices,
                       const std::string& semantic);
    /// For the back side: negates normals and tangents, with the sense of the third vector, as
    /// viewers do for double-sided faces.
    std::size_t gather_turned(const Json& accessor, const std::vector<std::uint32_t>& vertices,
                              const std::string& semantic);
    std::size_t add_texcoords(std::span<const glm::vec2> texcoords);
    /// 16 bits if `vertex_count` allows it, else 32.
    std::size_t add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertex_count);

private:
    const AccessorData& data_of(std::size_t accessor);
    std::size_t gather(const Json& accessor, const std::vector<std::uint32_t>& vertices,
                       const std::string& semantic, bool negated);
    std::size_t add_gathered(std::size_t source, std::span<const std::uint32_t> vertices,
                             bool with_bounds, bool negated);

    GlbBuilder& builder_;
    std::map<std::size_t, AccessorData> read_;
    std::map<std::vector<std::uint32_t>, std::size_t> orders_;  // each vertex order and its number
    std::map<std::tuple<std::size_t, std::size_t, bool, bool>, std::size_t> gathered_;
    std::map<std::pair<std::vector<std::uint32_t>, bool>, std::size_t> indices_;
};

}  // namespace lumel
