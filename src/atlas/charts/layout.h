#pragma once
// A primitive laid flat, before it has a place in the atlas.

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "atlas/charts/split.h"
#include "scene/values/scene.h"

namespace lumel {

/// One primitive cut into charts. Each chart lies in its own coordinates, in 0…size.
struct Layout {
    std::vector<std::uint32_t> source_vertex;  ///< [V] index into the primitive's vertex arrays
    std::vector<std::uint32_t> vertex_chart;   ///< [V]
    std::vector<glm::dvec2> place;             ///< [V] within the chart [m]
    std::vector<std::uint32_t> indices;        ///< [3T] as the primitive's
    std::vector<std::uint32_t> chart;          ///< [T] counted from 0
    std::vector<glm::dvec2> chart_size;        ///< [C] [m]
};

/// Positions of a primitive's vertices in the world.
std::vector<glm::dvec3> world_positions(const Primitive& primitive, const glm::mat4& transform);

/// Number of the welded vertex of each vertex: equal positions get equal numbers.
std::vector<std::uint32_t> weld(const std::vector<glm::vec3>& positions);

constexpr std::uint32_t kNoNeighbour = ~0u;

/// [3T] The triangle across each edge, where exactly two triangles of matching winding meet.
std::vector<std::uint32_t> neighbours(const std::vector<std::uint32_t>& welded,
                                      const std::vector<std::uint32_t>& indices);

/// Cuts a primitive into charts, each seen from its front and true to world scale.
/// `positions` [V] in the world; `mirrored`: the instance's transform flips the winding.
Layout make_charts(const Primitive& primitive, const std::vector<glm::dvec3>& positions,
                   bool mirrored, const ChartCost& cost);

/// Lets neighbouring charts that are thinner than a texel at this density [texels/m] share one
/// chart, lying over each other.
void bundle_thin_charts(Layout& layout, const std::vector<glm::dvec3>& positions, double density);

}  // namespace lumel
