#pragma once
// The triangles that can stand between two points of the scene, ready to be drawn.

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace lumel {

/// Indices of one material's triangles that let light through in places.
struct CutOut {
    int material = 0;
    std::uint32_t first_index = 0;
    std::uint32_t index_count = 0;
};

/// An indexed triangle list: opaque triangles first, then one range for each cut-out material.
struct Occluders {
    std::vector<glm::vec3> positions;      ///< [V] instance frame [m]
    std::vector<std::uint32_t> instances;  ///< [V] whose frame
    std::vector<glm::vec3> look;           ///< [V] (u, v, alpha factor) for cut-outs
    std::vector<std::uint32_t> indices;    ///< [3T]
    std::uint32_t opaque_index_count = 0;
    std::vector<CutOut> cut_outs;
};

/// Collects all triangles but those that have the whole scene on one side of their plane: the
/// outer walls of a room hide no point of the scene from another. `leave_out_hull`: false where
/// instances will move, which keeps every triangle.
Occluders find_occluders(const Scene& scene, bool leave_out_hull = true);

}  // namespace lumel
