#pragma once
// A small curved surface, plain and ready to be compressed.

#include <vector>

#include <glm/glm.hpp>

#include "gltf_builder.h"

namespace lumel::test {

/// A wavy square of 8 × 8 quads with normals and texture coordinates.
struct RayBatch {
    static constexpr int kSide = 9;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> texcoords;
    std::vector<std::uint16_t> indices;

    RayBatch();
    /// Accessors 0 to 3: positions, normals, texture coordinates, indices, each over a bufferView
    /// of its own.
    GltfBuilder plain() const;
};

/// The primitive of plain().
Json wave_primitive();

/// How Draco codes the wave.
struct DracoWay {
    bool edgebreaker = true;  ///< else vertices and triangles keep their order
    int position_bits = 0;    ///< 0: exact
    int normal_bits = 0;
};

/// The wave with all its data in a Draco stream, bufferView 0.
GltfBuilder draco_wave(const DracoWay& way);

/// A lossless WebP picture. rgba: [height][width][4].
Bytes make_webp(int width, int height, const Bytes& rgba);

}  // namespace lumel::test
