#pragma once
// Dividing charts that leave most of their rectangle empty: frames, rings, skirting boards.

#include <cstdint>
#include <vector>

#include "atlas/charts/polygon.h"

namespace lumel {

/// What charts will cost, as far as it is known before packing.
struct ChartCost {
    double texels_per_metre = 0.0;  ///< estimate; 0: charts are not divided
    int gutter = 2;                 ///< [texels]

    /// Texels that a chart of this size [m] takes, with its gutter.
    double operator()(const glm::dvec2& size) const;
};

/// Divides the triangles of one flat chart where that saves texels. `triangles` [m]. Returns
/// groups of indices into `triangles`, one for each chart.
std::vector<std::vector<std::uint32_t>> split_sparse(const std::vector<Polygon>& triangles,
                                                     const ChartCost& cost);

}  // namespace lumel
