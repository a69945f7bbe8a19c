#pragma once
// Encodes triangles as a Draco stream.

#include <cstdint>
#include <optional>
#include <vector>

#include "scene/gltf/draco_stream.h"

namespace lumel {

/// Rounding of floats: every component to the nearest origin[c] + n × step, 0 ≤ n < 2^bits.
struct DracoGrid {
    std::vector<float> origin;  ///< [components]
    float step = 0.0f;
    int bits = 0;
};

/// An attribute for the encoder. Without `grid` and `normal_bits`, values are exact.
struct DracoInput {
    enum class Kind { position, normal, texcoord, color, other } kind = Kind::other;
    AccessorData data;  ///< of a scalar or vector
    std::optional<DracoGrid> grid;
    int normal_bits = 0;  ///< of Kind::normal, floats: bits of each octahedral coordinate; else 0
};

/// A stream, and the mesh that it decodes to: attribute i of the input has the id i. Vertices and
/// triangles are in another order; those without area are left out.
struct EncodedDraco {
    Bytes stream;
    DracoMesh mesh;
};

/// indices: [3 * triangles] in range. attributes: of equally many vertices, one position at least.
/// Empty if Draco cannot hold the mesh.
std::optional<EncodedDraco> encode_draco(const std::vector<std::uint32_t>& indices,
                                         const std::vector<DracoInput>& attributes);

}  // namespace lumel
