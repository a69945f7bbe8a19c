#pragma once
// Where the atlas is torn though the surface is not.

#include <vector>

#include <glm/glm.hpp>

#include "atlas/atlas.h"

namespace lumel {

/// One edge of the world with two places in the atlas [texels]: a[0] and b[0] are the same point.
struct Seam {
    glm::vec2 a[2];
    glm::vec2 b[2];
};

/// All pairs of triangle edges, or of the parts of them that overlap, whose ends coincide in the
/// world, whose shading normals agree at both ends, and whose places in the atlas differ.
std::vector<Seam> find_seams(const Scene& scene, const Atlas& atlas);

}  // namespace lumel
