#pragma once
// Splits charts that leave most of their rectangle empty: frames, rings, skirting boards.

#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"

namespace lumel {

/// Estimated cost of charts before packing.
struct ChartCost {
    double texels_per_metre = 0.0;  ///< estimate; 0: charts are not split
    int gutter = 2;                 ///< [texels]

    /// Texels of a chart of this size [m], including its gutter.
    double operator()(const glm::dvec2& size) const;
};

/// Splits the triangles of a flat chart if that saves texels. `triangles` [m]. Returns groups of
/// indices into `triangles`, one per chart.
std::vector<std::vector<std::uint32_t>> split_sparse(const std::vector<Polygon>& triangles,
                                                     const ChartCost& cost);

}  // namespace lumel
