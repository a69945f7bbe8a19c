#pragma once
// Where the atlas is torn though the surface is not.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// One edge of the world with two places in the atlas [texels]: a[0] and b[0] are the same point.
struct Seam {
    glm::vec2 a[2];
    glm::vec2 b[2];
};

/// All pairs of triangle edges, or of the parts of them that overlap, whose ends coincide in the
/// world, whose shading normals agree at both ends, and whose places in the atlas differ.
std::vector<Seam> find_seams(const Scene& scene, const Atlas& atlas);

/// What finding and matching them takes, before there is a map.
struct SeamSizes {
    std::size_t edges = 0;  ///< of triangles, at borders of charts
    double length = 0.0;    ///< of them in the atlas [texels]
};
SeamSizes seam_sizes(const Atlas& atlas);

/// Bytes of that many edges while they are cut, welded and put in order.
std::uint64_t seam_edge_bytes(std::size_t edges);

}  // namespace lumel
