#pragma once
// Borders of charts, in the world and in the atlas.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace lumel {

struct EdgeEnd {
    glm::vec3 position;  // world
    glm::vec3 normal;    // world, unit
    glm::vec2 place;     // atlas [texels]
    std::uint32_t point = 0;
};

struct BorderEdge {
    EdgeEnd ends[2];
};

/// Cuts edges where ends of others lie on them, so that those that overlap share all of an edge.
/// tolerance: how far off an end may be [m].
void cut_at_ends(std::vector<BorderEdge>& edges, float tolerance);

}  // namespace lumel
