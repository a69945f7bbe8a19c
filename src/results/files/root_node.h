#pragma once
// Adds nodes to glTF files.

#include <glm/glm.hpp>

#include "base/json/json_view.h"

namespace lumel {

/// Adds a root node to the default scene. world: its transform, left out if it is the identity.
void add_root(Json& gltf, Json node, const glm::dmat4& world);

}  // namespace lumel
