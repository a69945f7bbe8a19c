#pragma once
// Flat layout of a primitive, before packing.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/charts/split.h"
#include "scene/values/scene.h"

namespace lumel {

/// A primitive cut into charts, each with its own coordinates in 0…size.
struct Layout {
    std::vector<std::uint32_t> source_vertex;  ///< [V] index into the primitive's vertex arrays
    std::vector<std::uint32_t> vertex_chart;   ///< [V]
    std::vector<glm::dvec2> place;             ///< [V] in the chart [m]
    std::vector<std::uint32_t> indices;        ///< [3T] as the primitive's
    std::vector<std::uint32_t> chart;          ///< [T] counted from 0
    std::vector<glm::dvec2> chart_size;        ///< [C] [m]
};

/// Positions of a primitive's vertices in the world.
std::vector<glm::dvec3> world_positions(const Primitive& primitive, const glm::mat4& transform);

/// Index of the welded vertex of each vertex: equal positions get equal indices.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions);

constexpr std::uint32_t kNoNeighbour = ~0u;

/// [3T] The adjacent triangle of each edge, if exactly two triangles of matching winding share it.
std::vector<std::uint32_t> neighbours(const std::vector<std::uint32_t>& welded,
                                      const std::vector<std::uint32_t>& indices);

/// Cuts a primitive into charts, each seen from its front and in world scale. `positions` [V] in
/// the world; `mirrored`: the instance's transform flips the winding.
Layout make_charts(const Primitive& primitive, const std::vector<glm::dvec3>& positions,
                   bool mirrored, const ChartCost& cost);

/// Superimposes neighbouring charts that are thinner than a texel at this density [texels/m].
void bundle_thin_charts(Layout& layout, const std::vector<glm::dvec3>& positions, double density);

}  // namespace lumel
