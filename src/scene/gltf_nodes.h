#pragma once
// The node hierarchy of a glTF file.

#include <vector>

#include <glm/glm.hpp>

#include "scene/gltf_document.h"

namespace lumel {

/// A node of the default scene and where it stands.
struct PlacedNode {
    std::size_t node = 0;   ///< index in the file
    glm::dmat4 world{1.0};  ///< node to world
};

/// Nodes reached from the default scene (else scene 0, else from every root), in file order.
/// Throws Error{input} for cycles, nodes with two parents and transforms that are not finite.
std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace lumel
