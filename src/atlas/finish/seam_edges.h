#pragma once
// Seams: edges that the atlas separates although the surface is continuous.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/packing/atlas.h"

namespace lumel {

/// An edge of the world with two atlas positions [texels]: a[0] and b[0] are the same point.
struct Seam {
    glm::vec2 a[2];
    glm::vec2 b[2];
};

/// All pairs of triangle edges, or of overlapping parts of them, whose ends coincide in the
/// world, whose shading normals agree at both ends, and whose atlas positions differ.
std::vector<Seam> find_seams(const Scene& scene, const Atlas& atlas);

/// Size of the seam problem, known before there is a map.
struct SeamSizes {
    std::size_t edges = 0;  ///< triangle edges at chart borders
    double length = 0.0;    ///< their length in the atlas [texels]
};
SeamSizes seam_sizes(const Atlas& atlas);

/// Memory of that many edges during splitting, welding and sorting [bytes].
std::uint64_t seam_edge_bytes(std::size_t edges);

}  // namespace lumel
