#pragma once
// Regular grid of light probes in a box.

#include <vector>

#include <glm/glm.hpp>

namespace lumel {

/// Cells of a box, with a probe at the centre of each.
struct ProbeGrid {
    double spacing = 0.0;                    ///< between neighbours, along every axis [m]
    glm::dvec3 first{0.0};                   ///< probe of lowest x, y and z [m]
    glm::ivec3 counts{0};                    ///< along x, y and z, each at least 1
    std::vector<glm::dvec3> points() const;  ///< [z][y][x]: x fastest [m]
};

/// Maximum number of probes in a grid.
inline constexpr double kMaxProbes = 1e6;

/// As many as fit between two corners, with equal margins on opposite sides. Throws Error{input}
/// for more than kMaxProbes.
ProbeGrid probe_grid(const glm::dvec3& low, const glm::dvec3& high, double spacing);

}  // namespace lumel
