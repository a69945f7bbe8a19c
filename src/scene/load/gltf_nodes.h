#pragma once
// The node hierarchy of a glTF file.

#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf/document.h"
#include "scene/values/node_place.h"

namespace lumel {

/// A node of the default scene and where it stands.
struct PlacedNode {
    std::size_t node = 0;   ///< index in the file
    glm::dmat4 world{1.0};  ///< node to world
};

/// The scene to show: the one the file chooses, else its first; nothing if it has none.
std::optional<JsonView> default_scene(const JsonView& root);

/// The rotation given by "rotation" of an object, none if absent. Throws Error{input} unless it is
/// a unit quaternion.
glm::dquat rotation_of(const JsonView& object);

/// Where a node stands relative to its parent. Throws Error{input} for what is no transform.
NodePlace read_place(const JsonView& node);

/// Parents [nodes] of the file's nodes, -1: none. Throws Error{input} for cycles and nodes with two
/// parents.
std::vector<int> parents_of(const JsonView& root);

/// Nodes reached from the default scene (else scene 0, else from every root), in file order.
/// Throws Error{input} for cycles, nodes with two parents and transforms that are not finite.
std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace lumel
