#pragma once
// Border edges of charts, in the world and in the atlas.

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

/// Splits edges at ends of others that lie on them, so that overlapping edges coincide. tolerance:
/// maximum distance of an end [m].
void cut_at_ends(std::vector<BorderEdge>& edges, float tolerance);

}  // namespace lumel
