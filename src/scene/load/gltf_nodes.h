#pragma once
// The node hierarchy of a glTF file.

#include <optional>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "scene/gltf/document.h"
#include "scene/values/node_place.h"

namespace lumel {

/// A node of the default scene with its transform.
struct PlacedNode {
    std::size_t node = 0;   ///< index in the file
    glm::dmat4 world{1.0};  ///< node to world
};

/// The scene that the file chooses, else its first; nullopt if it has none.
std::optional<JsonView> default_scene(const JsonView& root);

/// The rotation in "rotation" of an object; identity if absent. Throws Error{input} unless it is a
/// unit quaternion.
glm::dquat rotation_of(const JsonView& object);

/// Transform of a node relative to its parent. Throws Error{input} if it is invalid.
NodePlace read_place(const JsonView& node);

/// Parents of the file's nodes [nodes], -1: none. Throws Error{input} for cycles and nodes with two
/// parents.
std::vector<int> parents_of(const JsonView& root);

/// Nodes below the default scene (else scene 0, else all roots), in file order. Throws Error{input}
/// for cycles, nodes with two parents and transforms that are not finite.
std::vector<PlacedNode> place_nodes(const GltfDocument& document);

}  // namespace lumel
